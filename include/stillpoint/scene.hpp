// A scene: the plain data of one problem, read from TOML and validated as a whole.
//
// SI units unless a scene says that it is dimensionless. Vectors have Dim entries; in one dimension a scene may write a
// plain number. Every number may also be a string: a formula in the scene's constants.
#pragma once

#include <stillpoint/expression.hpp>
#include <stillpoint/integrator.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace stillpoint {

enum class BasisKind { linear, quadratic, cubic, hermite };
enum class StressState { uniaxial_stress, uniaxial_strain };
enum class Placement { uniform, gauss, random };
enum class VolumeRule { equal, consistent };
enum class MassKind { consistent, lumped };

/// Where something stands: a file with line and column (1-based), or an override, "--set key=value", with line 0.
struct Location {
  std::string file;
  int line = 0, column = 0;
};
/// "file:line:column", or the file alone where there is no line.
std::string to_string(const Location& where);

/// One thing that is wrong with a scene.
struct Problem {
  Location where;
  std::string message;  // what, and what was expected
};

/// All that is wrong with a scene, found at once. what() has a line for each problem.
class SceneError : public std::runtime_error {
 public:
  explicit SceneError(std::vector<Problem> problems);
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

struct GridSpec {                // [grid]
  std::vector<double> min, max;  // [m]
  std::vector<int> cells;
  BasisKind basis = BasisKind::linear;
};

struct BodySpec {                // [body]: a box of material points
  std::vector<double> min, max;  // [m], inside the grid
  std::string material;          // a [material.<name>]
  StressState state = StressState::uniaxial_stress;
  double area = 1;  // cross-section [m²]
  Placement placement = Placement::uniform;
  std::vector<int> points_per_cell = {2};
  VolumeRule volumes = VolumeRule::consistent;
  unsigned long seed = 1;  // of placement = "random"
};

struct MaterialSpec {  // [material.<name>]
  std::string name, law;
  std::map<std::string, double> parameters;  // complete: defaults filled in
};

struct SupportSpec {       // [[support]]: u(at) = motion(t)
  std::vector<double> at;  // [m]
  int component = 0;
  Expression motion;  // of t [m]; 0: fixed
};

struct PointForceSpec {           // [[force]]
  std::vector<double> at;         // [m]
  std::vector<Expression> value;  // of t [N]
};

struct TractionSpec {             // [[traction]]: a dead load on a face of the body
  int axis = 0;                   // 0: left/right
  bool upper = true;              // right
  std::vector<Expression> value;  // of t [Pa]
};

struct DampingSpec {  // [damping]
  std::string strategy = "viscous";
  std::optional<double> c;  // empty: "critical", 2 ω₁
  double alpha = 0.7;
};

struct IntegratorSpec {  // [integrator]
  std::string method = "leapfrog";
  DampingTreatment treatment = DampingTreatment::automatic;
  std::optional<double> step;            // [s]
  double step_fraction = 0.9;            // of the critical step, where step is not given; the cap of an adaptive step
  std::optional<double> rtol;            // adaptive where given
  std::optional<double> atol_u, atol_v;  // [m], [m/s]; default: rtol times the scene's own scale
  std::string unstable_reason;           // why a step past the critical one is wanted
};

struct StopSpec {                // [stop]: a test set to 0 is off
  double residual = 1e-6;        // ‖F − R‖/‖F‖
  double kinetic_energy = 1e-6;  // share of the largest kinetic energy so far; goes with residual
  double hold = 1;               // both held for this many periods 2π/ω₁
  double time = 0;               // end time [s]
  long steps = 10'000'000;
  double wall_time = 0;  // [s]
};

struct OutputSpec {  // [output]
  double every = 0;  // time between rows of the history [s]; 0: chosen
};

struct ProbeSpec {  // [[probe]]
  std::string name;
  std::optional<int> point;         // 1-based number of a material point, in order of place
  std::vector<double> at;           // or the material point nearest to this place [m]
  std::vector<std::string> fields;  // of "u", "v", "strain", "stress"
};

struct VariantSpec {  // [[variant]]: the same scene with other values, drawn beside it
  std::string name;
  std::vector<std::string> set;  // "key=value" as for --set
};

struct Scene {
  std::string name;  // the file's stem
  std::string title;
  std::filesystem::path file;
  int dim = 1;
  Constants constants;
  GridSpec grid;
  BodySpec body;
  std::map<std::string, MaterialSpec> materials;
  MassKind mass = MassKind::consistent;
  std::vector<SupportSpec> supports;
  std::vector<PointForceSpec> forces;
  std::vector<TractionSpec> tractions;
  std::vector<Expression> body_force;            // of x, y, z, t; per mass [m/s²]; empty: none
  std::vector<Expression> initial_u, initial_v;  // of x, y, z [m], [m/s]; empty: 0
  std::vector<Expression> exact_u;               // of x, y, z, t [m]; empty: not known
  std::optional<Expression> exact_stress;        // of x, y, z, t [Pa]
  DampingSpec damping;
  IntegratorSpec integrator;
  StopSpec stop;
  OutputSpec output;
  std::vector<ProbeSpec> probes;
  std::vector<VariantSpec> variants;
  std::map<std::string, Location> where;  // dotted key ("support[0].at") → place, for what is found wrong later

  /// Place of a key, or of the nearest table around it that was written.
  Location location(const std::string& key) const;
};

/// Reads, checks and completes a scene; overrides are "dotted.key=value" with a TOML value (a bare word is a string).
/// Throws SceneError with every problem.
Scene load_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The candidate with the smallest edit distance to word, for "did you mean"; empty where none is near.
std::string nearest(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace stillpoint
