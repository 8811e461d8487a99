// A problem: the complete input of a run as plain values, from a scene file (scene.hpp) or from a program.
//
// Values that may be left open are Choices; resolve() makes those that nobody asked for. A program may change values
// and resolve the problem again. SI units unless a problem is dimensionless. Vectors have dim entries. Comments name
// the table of a scene file that gives each part, and the members follow its keys.
#pragma once

#include <stillpoint/boundary_specs.hpp>
#include <stillpoint/choice.hpp>
#include <stillpoint/expression.hpp>
#include <stillpoint/scene_error.hpp>
#include <stillpoint/scene_options.hpp>

#include <array>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace stillpoint {

struct GridPiece {          // a row of grid.x, grid.y or grid.z: a part of an axis
  double from = 0, to = 0;  // [m]
  int cells = 1;
  double ratio = 1;  // length of the last cell over that of the first; between them the lengths are a geometric series
};

struct GridSpec {                // [grid]
  std::vector<double> min, max;  // [m]
  std::vector<int> cells;
  // The axes x, y and z piece by piece, each piece beginning where the one before ends. If any is given, all are, and
  // resolve() sets min, max and cells by them. If all are empty, the cells along an axis are equal.
  std::array<std::vector<GridPiece>, 3> pieces{};
  BasisKind basis = BasisKind::linear;
  std::string follow;  // the [[wall]] whose face of the grid moves with it; empty: the grid stays where it is

  bool is_by_pieces() const { return !pieces[0].empty() || !pieces[1].empty() || !pieces[2].empty(); }
};

struct PointOutline {                                     // outline of a body of points in the plane
  std::vector<std::vector<std::array<double, 2>>> loops;  // closed loops with the material on their left [m]
  double spacing = 0;                                     // the widest spacing of the points [m]
};

struct BodySpec {    // [body], or several [[body]]: material points in a shape or from a file
  std::string name;  // by which contacts name it; empty: none
  // The box [m], inside the grid; of another shape the part of its bounding box inside the grid.
  Choice<std::vector<double>> min, max;
  // Shapes other than the box:
  std::vector<std::vector<double>> polygon;   // corners in order, (corners × 2) [m]; in space a prism:
  int axis = 2;                               // axis of the prism's extrusion, from min to max
  std::vector<double> sphere;                 // centre of a sphere [m]
  std::vector<std::vector<double>> cylinder;  // centres of a cylinder's ends, (2 × 3) [m]
  double radius = 0, inner_radius = 0;        // radii of a sphere or cylinder [m]; inner: 0 if it is solid
  std::filesystem::path stl;                  // file of a closed surface of triangles
  std::filesystem::path mesh;                 // file of a mesh of Gmsh's; resolve() makes a polygon or triangles of it
  std::string group;                          // physical group of the mesh that the body is; empty: all of them
  std::filesystem::path file;                 // CSV of points: x, y, volume (with thickness); empty: the shape is
                                              // filled with points
  PointOutline outline;                       // outline of the points of `file`, if a load acts on it
  std::string material;                       // name of a [material.<name>]
  std::optional<StressState> state;           // as written; Scene::state holds for all bodies
  double area = 1;                            // cross-section in one dimension [m²], thickness in two [m]
  std::size_t number = 0;                     // which body of the problem it is, in all its stages
  Placement placement = Placement::uniform;
  std::vector<int> points_per_cell = {2};  // along each coordinate
  double jitter = 0;                       // random shift of each point, as a share of half its spacing at most
  Choice<VolumeRule> volumes = Choice<VolumeRule>::open(VolumeRule::consistent);
  unsigned long seed = 1;  // seed of placement = "random" and of jitter

  StlSolid from_stl{};  // contents of `stl`, or of `mesh` in space; resolve() reads them, once

  BodyShape shape() const {
    if (!polygon.empty()) return BodyShape::polygon;
    if (!sphere.empty()) return BodyShape::sphere;
    if (!cylinder.empty()) return BodyShape::cylinder;
    if (!stl.empty() || !mesh.empty()) return BodyShape::triangles;
    return file.empty() ? BodyShape::box : BodyShape::points;
  }
  bool is_box() const { return shape() == BodyShape::box; }
  /// Whether the body is filled with points and has another shape than a box.
  bool has_shape() const { return !is_box() && shape() != BodyShape::points; }
};

struct StrengthRow {                   // a row of material.<name>.softening: the strength from a plastic strain on
  double plastic_strain, c, phi, psi;  // [1], [Pa], [degrees]
};
inline constexpr std::size_t most_strength_rows = 8;

struct MaterialSpec {  // [material.<name>]
  std::string name, law;
  std::map<std::string, double> parameters;    // complete: defaults filled in
  std::map<std::string, std::string> choices;  // likewise complete, for parameters that are words (cone = "mean")
  std::vector<StrengthRow> softening{};        // by plastic strain > 0; empty: the strength stays as it is
  std::optional<double> softening_length{};    // width of a band of softened ground [m]; empty: that of a cell
  /// Parameters that are formulas of x, y, z before the motion; in `parameters` they are 1.
  std::map<std::string, Expression> by_place{};
  bool undrained = false;                 // saturated with water that cannot flow
  std::optional<double> water_modulus{};  // K_w [Pa]; empty: such that the undrained Poisson's ratio is 0.495
  double porosity = 1;                    // n, beside water_modulus
  bool undrained_dilatancy = false;       // whether it may dilate all the same, and become stronger without end
  // For a law from a shared library:
  std::filesystem::path library{};    // its file
  std::vector<double> props{};        // its constants
  std::vector<std::string> statev{};  // the names of its state variables, as many as it has; "" is not shown
};

struct ExactSpec {                             // [exact]: the exact solution, if it is known
  std::vector<Expression> u{};                 // formulas of x, y, z, t [m]; empty: not given by formulas
  std::vector<Expression> stress{};            // Cauchy stress, likewise, (stress components) [Pa]
  std::string solution{};                      // or the name of a built-in solution; its material is that of the bodies
  std::map<std::string, double> parameters{};  // parameters of that solution: complete
  std::map<std::string, std::string> choices{};  // its parameters that are words: complete

  bool known() const { return !u.empty() || !solution.empty(); }
};

struct SolveSpec {                    // [solve]
  std::string method = "relaxation";  // or a static solver: "newton", "newton-cg", "cg", "lbfgs"
  int load_steps = 1;                 // for a static solver: equal shares of the load; points remember the end of each
  bool is_static() const { return method != "relaxation"; }
};

struct DampingSpec {  // [damping]
  std::string strategy = "viscous";
  std::optional<double> c;  // empty: "critical", 2 ω₁
  Choice<double> alpha = Choice<double>::open(0.7);
  Peak peak = Peak::half_step;           // for strategy = "kinetic"
  Quotient quotient = Quotient::global;  // for strategy = "adaptive"
};

struct IntegratorSpec {  // [integrator]
  std::string method = "leapfrog";
  DampingTreatment treatment = DampingTreatment::automatic;
  std::optional<double> step;  // [s]
  // The share of the critical step, if step is not given; the cap of an adaptive step.
  Choice<double> step_fraction = Choice<double>::open(0.9);
  std::optional<double> rtol;            // if given, the step is adaptive
  std::optional<double> atol_u, atol_v;  // [m], [m/s]; default: rtol times the scene's own scale
  std::string unstable_reason;           // why a step past the critical one is intended
};

struct StopSpec {          // [stop]: a test set to 0 is off
  double residual = 1e-6;  // ‖F − R‖/‖F‖
  /// The certified bound on ‖u − u*‖_V/‖u‖_V (ErrorBound) that ends the run; open: see Model::distance_goal.
  Choice<double> distance = Choice<double>::open(0);
  double kinetic_energy = 1e-6;  // share of the largest kinetic energy so far; tested with residual and distance
  double dwell = 1;              // number of periods 2π/ω₁ during which both hold
  double load_growth = 0;  // (q − q₀)/(λ − λ₀) dλ/dq at which driven loads are at their limit (LimitLoad)
  double time = 0;         // end time [s]
  long steps = 10'000'000;
  double wall_time = 0;  // [s]

  bool wants_equilibrium() const { return residual > 0 || distance > 0; }
};

struct OutputSpec {                            // [output]
  double every = 0;                            // time between rows of the history [s]; 0: chosen
  std::vector<double> snapshots;               // times at which the fields of all points are written [s]
  double fields_every = 0;                     // or the time between such writes [s]; 0: at the stages only
  std::vector<std::string> format = {"xdmf"};  // of these files: "xdmf" (fields.h5, fields.xdmf), "vtu" (fields.pvd)
};

struct CheckpointSpec {  // [checkpoint]: intervals at which the state is saved, so that the run can be resumed
  double every = 0;      // wall time between checkpoints [s]; 0: none by time
  long every_steps = 0;  // steps between checkpoints; 0: none by steps

  bool wanted() const { return every > 0 || every_steps > 0; }
};

struct PhaseSpec {  // [phase]: when the points move on and the grid is reset
  /// The value "none" of max_motion.
  static constexpr double never = std::numeric_limits<double>::infinity();
  /// A phase ends once some point has moved by this share of a cell; 0: after every step (classical MPM).
  Choice<double> max_motion = Choice<double>::open(never);
  std::optional<double> max_strain;  // or once some component of ∂u/∂x exceeds this; empty: not tested
  double rest = 0;                   // parts rest that move by less than this share of the largest motion; 0: none does
  Choice<Transfer> transfer = Choice<Transfer>::open(Transfer::flip);
  Choice<double> flip_share = Choice<double>::open(1);  // for "flip": 1 adds the increment of the nodal velocity, 0
                                                        // takes that velocity itself
  int xpic_order = 5;                                   // the order m of "xpic"
  Choice<DeformationRule> deformation = Choice<DeformationRule>::open(DeformationRule::positions);
  Choice<Quadrature> quadrature = Choice<Quadrature>::open(Quadrature::points);
  Dilatation dilatation = Dilatation::points;

  bool ends_by_motion() const { return max_motion < never; }
  bool at_stages = false;  // or when a stage of the scene ends; set by what the scene has

  /// Whether a phase ever ends, so that bodies move on.
  bool ends() const { return ends_by_motion() || max_strain || at_stages; }
};

struct MassSpec {  // [mass]
  Choice<MassKind> kind = Choice<MassKind>::open(MassKind::consistent);
  Choice<MassScaling> scaling = Choice<MassScaling>::open(MassScaling::uniform);
  Choice<double> factor = Choice<double>::open(1);  // factor on the inertia, not on the weight; the key is scaling too

  bool scaling_is_asked() const { return scaling.is_asked() || factor.is_asked(); }
};

struct GeostaticSpec {  // [initial.geostatic]: initial stress below a horizontal surface
  Expression K0{};      // a formula of x, y, z: σ'_xx = σ'_zz = K0 σ'_yy, and σ_yy is the weight above
  double surface = 0;   // [m]
  /// Height of the level of the water that the pores of undrained materials are full of [m]; empty: no pore pressure.
  std::optional<double> water_table{};
  double water_density = 1000;  // [kg/m³]
};

struct StageSpec {  // [[stage]]: what changes at a time of the run
  /// When the stage begins, at the earliest [s].
  double at = 0;
  std::vector<std::string> add, remove;       // the names of bodies, also rigid ones, that appear, and of those that go
  std::vector<std::string> hold, release;     // the names of supports and loads that begin and end
  std::vector<std::string> change, material;  // the names of bodies, and of the material that each has from now on
  /// A formula of x, y, z: bodies that appear bear the weight of what appears above them, σ_yy, with σ_xx = σ_zz = K0
  /// σ_yy; empty: they appear without stress.
  std::optional<Expression> K0{};
  /// Whether it lasts until the body is in equilibrium, at least.
  bool equilibrium = false;
  /// The time over which its changes come into force [s]; open: half its length, see stage_ramp().
  Choice<double> ramp = Choice<double>::open(0);
};

/// The frame of a probe: it moves with the material, or stays in space.
enum class ProbeFrame { material, space };
enum class ProbeKind { point, slope_angle, mean, body };

struct ProbeSpec {  // [[probe]]
  std::string name;
  ProbeKind kind = ProbeKind::point;
  // For a point:
  std::optional<int> point;  // 1-based number of a material point, in order of position
  std::vector<double> at;    // or its initial position [m]
  ProbeFrame frame = ProbeFrame::material;
  // For a mean:
  std::vector<double> min, max;  // the box whose material points at the start are averaged over [m]
  // For all kinds but slope_angle:
  std::vector<std::string> fields;  // names from probe_fields(dim), or of history variables of the materials' laws; for
                                    // a body from body_fields(dim)
};
/// The fields that a probe of a point or of a mean may name: "u", "v", "strain", "stress" in one dimension, their
/// components in two.
std::vector<std::string> probe_fields(int dim);
/// The fields that a probe of the whole body may name: "volume", "momentum" with its components, "angular_momentum".
std::vector<std::string> body_fields(int dim);

struct Problem : BoundarySpecs {
  std::string name;   // for a scene the stem of its file name
  std::string title;  // empty: the name stands for it
  int dim = 1;
  Constants constants;  // constants that formulas may use
  GridSpec grid;
  StressState state = StressState::uniaxial_stress;  // common to all bodies; resolve() sets it
  std::vector<BodySpec> bodies;
  std::map<std::string, MaterialSpec> materials;
  MassSpec mass;
  PhaseSpec phase;
  std::vector<Expression> initial_u, initial_v;  // formulas of x, y, z [m], [m/s]; empty: 0
  std::vector<double> initial_stress;  // [initial] stress, the same everywhere, (stress components) [Pa]; empty: 0
  std::optional<GeostaticSpec> geostatic;
  std::filesystem::path initial_from;    // a checkpoint of another scene whose points the bodies take over; empty: none
  bool displacements_from_zero = false;  // whether their displacements count from there
  // Stages. The members above are what there is in the present one.
  std::vector<StageSpec> stages;              // those that follow, in time
  std::vector<BodySpec> later_bodies;         // that they add
  std::vector<SupportSpec> later_supports;    // that they begin to hold
  std::vector<RigidSpec> later_rigid;         // that they add
  std::vector<PointForceSpec> later_forces;   // that begin with them
  std::vector<TractionSpec> later_tractions;  // likewise
  std::optional<LoadSpec> later_load;         // that begins with one of them
  std::vector<std::string> named_supports;    // the names of those of all stages, as written
  std::vector<std::string> named_bodies;      // likewise
  std::vector<RigidSpec> rigid_as_written;    // those of all stages
  std::optional<StageSpec> present_stage{};   // what the present stage is; empty: the beginning of the run
  ExactSpec exact;
  SolveSpec solve;
  DampingSpec damping;
  IntegratorSpec integrator;
  StopSpec stop;
  OutputSpec output;
  CheckpointSpec checkpoint;
  std::vector<ProbeSpec> probes;
};

/// Whether a load, a support or a wall depends on t.
bool loads_vary(const Problem& problem);

/// The problem with every open choice made, and with every position that misses a grid line by a rounding error put
/// onto it, checked as a whole. Choices that were made before are made again. Throws SceneError, whose problems name
/// the keys that a scene file would have.
Problem resolve(Problem problem);

}  // namespace stillpoint
