// Contact of bodies with each other: the border of the first body of a [[contact]] against that of the second.
//
// When a phase begins, each piece of the first border gets the facet of the second that is opposite to it
// (facet_search.hpp), and keeps it while the phase lasts: exact for what moves less than a facet along the other body,
// and linear while it is closed. Both bodies have fields of motion of their own (motion_fields.hpp). What one body
// bears the other exerts: no force is lost, and of a moment no more than by the way along each other within a phase.
//
// The stiffness of a patch is that of the two bodies in series, 1/κ = 1/κ_1 + 1/κ_2, with the mean κ_2 of the second.
//
// While a stage of the run has only one of the two bodies, its border is followed all the same: the other may come.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "space/boundary/contact_force.hpp"
#include "space/boundary/facet_finder.hpp"

namespace stillpoint {

template <Kinematics K>
class BodyContact {
  static constexpr int dim = dimensions(K), N = TouchFinder<K>::N;
  using Position = Eigen::Vector<double, N>;

 public:
  using Parts = PhaseParts<dim>;

  /// The problem must outlive this object; grid: that of the first phase.
  BodyContact(const Problem& problem, const Grid<dim>& grid);

  /// Throws SceneError if the bodies of a contact overlap by more than half a cell when the second of them appears.
  void begin_phase(const Parts& phase, const StiffnessBound& stiffness_bound);
  /// in_place: see ContactSurface.
  void end_phase(const double* u, bool in_place);
  void archive(const StateArchive& state);
  /// Before the first phase of a stage: takes over what the stage before remembers, as archive() saved it.
  void take_over(const StateArchive& state);
  /// Before the first phase: moves borders to where another run has left them.
  void leave_placed(const WaysSincePlaced<dim>& ways);

  /// R −= the forces at u, (n); at_supports: the same at prescribed unknowns.
  void add_force(const double* u, Vec R, Vec at_supports) const;
  /// As RigidContact's.
  void add_product(Tangent kind, const double* u, const double* du, Vec dR) const;
  void add_entries(Tangent kind, const double* u, MatrixEntries& entries) const;
  double growth() const;

  void commit(const double* u);
  void update_multipliers(const double* u, bool evenly);
  double friction_work() const {
    double work = 0;
    for (const Pair* const pair : whole_) work += pair->force.friction_work();
    return work;
  }
  bool is_touched(const double* u) const {
    return std::ranges::any_of(whole_, [&](const Pair* pair) { return pair->force.is_touched(0, u); });
  }
  void add_fit(const double* u, ContactFit& fit) const;
  void add_reports(const double* u, std::vector<ContactReport>& to) const;
  /// Where bodies of a contact lie in each other at u without feeling it, at most one place for each contact.
  std::vector<Intrusion> intrusions(const double* u) const;

 private:
  struct Pair {
    Pair(const Problem& problem, std::size_t number, const Grid<dim>& grid);
    Pair(const Pair&) = delete;  // its parts know where its surfaces are
    Pair& operator=(const Pair&) = delete;

    const ContactSpec& spec;
    std::size_t number;
    ContactSurface<K> first, second;
    ContactForce<K, FacetFinder<K>> force;
    bool was_whole = false;      // whether both bodies were there in the stage before
    std::vector<Position> slip;  // the elastic slip of each piece when the last phase ended, with friction [m]
  };

  void oppose(Pair& pair, const Parts& phase) const;
  void refuse_overlap(const Pair& pair) const;
  static void end_phase_of(Pair& pair, const double* u);
  /// By how much the borders of the two bodies have turned on each other where they touch since the phase began, where
  /// most [rad].
  static double turned(const Pair& pair, const double* u);
  /// How far pieces that touch have moved along what they touch since then, where most [cells].
  static double slid(const Pair& pair, const double* u);
  /// The part of the force that acts along normals of facets that are opposite no more [N].
  static std::array<double, 3> strayed(const Pair& pair, const double* u);
  static std::string name_of(const Pair& pair);
  static void archive_slip(const StateArchive& state, Pair& pair);

  const Problem& problem_;
  std::vector<std::unique_ptr<Pair>> pairs_;
  std::vector<Pair*> whole_;  // those of which both bodies are there
  bool has_begun_ = false;
};

}  // namespace stillpoint
