#include "space/boundary/conditions.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "space/boundary/body_contact.hpp"
#include "space/boundary/rigid_contact.hpp"
#include "space/boundary/way_since_placed.hpp"

namespace stillpoint {
namespace {

template <int Dim>
bool stay_what_they_are(const BoundaryConditions<Dim>& all) {
  return std::ranges::none_of(all, [](const auto& one) { return one->varies() || one->follows(); });
}

}  // namespace

template <Kinematics K>
Conditions<K>::Conditions(const Problem& problem, const Problem& whole, const Grid<dim>& grid, const Body<K>& body,
                          const std::vector<double>& origin, double time_scale)
    : problem_(problem),
      depths_(problem, body.first_number, origin),
      all_(make_boundary_conditions<K>(problem, grid, time_scale)),
      axis_(problem, grid, body, time_scale),
      weak_supports_(problem, grid, time_scale),
      load_control_(whole, grid, time_scale),
      rigid_contact_(std::make_unique<RigidContact<K>>(problem, grid, body.first_number, time_scale)),
      body_contact_(std::make_unique<BodyContact<K>>(problem, grid)) {
  for (const auto& condition : all_) {
    Contact* found = condition->contact();
    if (found && contact_) throw std::logic_error("two kinds of boundary conditions have contact");
    if (found) contact_ = found;
  }
}

template <Kinematics K>
Conditions<K>::~Conditions() = default;

// Supports come first, so that reactions on the axis which they take count as theirs.
template <Kinematics K>
HeldUnknowns Conditions<K>::hold(double t, const GridFunctions<dim>& functions, const MaterialPoints<dim>& points,
                                 const PointFunctions<dim>& weights, const std::vector<char>& reached,
                                 const Ranks* ranks) {
  const FaceGaps<dim> gaps(functions, points, weights, depths_, ranks);
  HeldUnknowns held(dim * reached.size(), t);
  for (const auto& condition : all_) condition->hold(functions, reached, gaps, held);
  axis_.hold(functions, points, weights, reached, ranks, held);
  return held;
}

template <Kinematics K>
void Conditions<K>::begin_phase(const Parts& phase, double t, const StiffnessBound& stiffness_bound, Vec F) {
  for (const auto& condition : all_) condition->begin_phase(phase, F);
  weak_supports_.begin_phase(phase, stiffness_bound);
  load_control_.begin_phase(phase, stiffness_bound);
  rigid_contact_->begin_phase(phase, t, stiffness_bound);
  body_contact_->begin_phase(phase, stiffness_bound);
  fading_.begin_phase(phase);
}

template <Kinematics K>
void Conditions<K>::begin_motion(const Parts& phase, double t, Vec v) {
  for (const auto& condition : all_) condition->begin_motion(phase, t, v);
}

template <Kinematics K>
bool Conditions<K>::move_rigid_bodies_on(double share) {
  return rigid_contact_->move_on(share);
}

template <Kinematics K>
bool Conditions<K>::loads_are_constant() const {
  return !fading_.acts() && stay_what_they_are(all_);
}

template <Kinematics K>
bool Conditions<K>::let_parts_rest(double t) const {
  return fading_.is_over(t) && !weak_supports_.move() && stay_what_they_are(all_);
}

template <Kinematics K>
bool Conditions<K>::loads_follow() const {
  return std::ranges::any_of(all_, [](const auto& condition) { return condition->follows(); });
}

template <Kinematics K>
void Conditions<K>::add_loads(const Parts& phase, double t, Vec F) const {
  for (const auto& condition : all_) condition->add_load(phase, t, F);
  fading_.add_load(t, F);
}

template <Kinematics K>
void Conditions<K>::add_following_loads(const Parts& phase, double t, const double* u, Vec F) const {
  for (const auto& condition : all_)
    if (condition->follows()) condition->add_following_force(phase, t, u, F);
}

template <Kinematics K>
SparseMatrix Conditions<K>::tangent_of_loads(const Parts& phase, double t, const double* u) const {
  MatrixEntries entries;
  for (const auto& condition : all_) condition->add_following_tangent(phase, t, u, entries);
  const auto n = static_cast<Eigen::Index>(phase.dofs.size());
  SparseMatrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}  // NOLINT(clang-analyzer-unix.Malloc): the analyzer loses sight of Eigen's destructor

template <Kinematics K>
void Conditions<K>::add_force(double t, const double* u, Vec R, Vec reactions) const {
  const std::size_t with_springs = reactions.size() - rigid_contact_->forces(), prescribed = with_springs - springs();
  weak_supports_.springs().add_force(t, u, R, reactions.first(prescribed + weak_supports_.springs().size()));
  load_control_.springs().add_force(t, u, R, reactions.first(with_springs));
  add_contact(t, u, R, reactions);
}

template <Kinematics K>
void Conditions<K>::add_contact(double t, const double* u, Vec R, Vec reactions) const {
  const std::size_t with_springs = reactions.size() - rigid_contact_->forces(), prescribed = with_springs - springs();
  rigid_contact_->add_force(t, u, R, reactions.first(prescribed), reactions.subspan(with_springs));
  body_contact_->add_force(u, R, reactions.first(prescribed));
}

template <Kinematics K>
void Conditions<K>::add_product(Tangent kind, double t, const double* u, const double* du, Vec dR) const {
  weak_supports_.springs().add_product(du, dR);
  load_control_.springs().add_product(du, dR);
  rigid_contact_->add_product(kind, t, u, du, dR);
  body_contact_->add_product(kind, u, du, dR);
}

template <Kinematics K>
void Conditions<K>::add_matrix(Tangent kind, double t, const double* u, SparseMatrix& matrix) const {
  weak_supports_.springs().add_matrix(matrix);
  if (!may_touch()) return;
  MatrixEntries entries;
  rigid_contact_->add_entries(kind, t, u, entries);
  body_contact_->add_entries(kind, u, entries);
  SparseMatrix of_contact(matrix.rows(), matrix.cols());
  of_contact.setFromTriplets(entries.begin(), entries.end());
  matrix += of_contact;
}  // NOLINT(clang-analyzer-unix.Malloc): the analyzer loses sight of Eigen's destructor

template <Kinematics K>
std::size_t Conditions<K>::other_reactions() const {
  return springs() + rigid_contact_->forces();
}

template <Kinematics K>
bool Conditions<K>::remember() const {
  return problem_.rubs() || std::ranges::any_of(problem_.rigid, &RigidSpec::free);
}

template <Kinematics K>
void Conditions<K>::commit(double t, const double* u) {
  rigid_contact_->commit(t, u);
  body_contact_->commit(u);
}

template <Kinematics K>
double Conditions<K>::growth_of_springs() const {
  return std::max({weak_supports_.growth(), rigid_contact_->growth(), body_contact_->growth()});
}

template <Kinematics K>
void Conditions<K>::update_multipliers(double t, const double* u, bool evenly, Vec R, Vec reactions) {
  const auto forces = [&] {
    std::pair of(std::vector<double>(R.size(), 0.0), std::vector<double>(reactions.size(), 0.0));
    add_contact(t, u, of.first, of.second);
    return of;
  };
  const auto before = forces();
  rigid_contact_->update_multipliers(t, u, evenly);
  body_contact_->update_multipliers(u, evenly);
  const auto now = forces();
  for (std::size_t k = 0; k < R.size(); ++k) R[k] += now.first[k] - before.first[k];
  for (std::size_t k = 0; k < reactions.size(); ++k) reactions[k] += now.second[k] - before.second[k];
}

template <Kinematics K>
std::vector<ContactReport> Conditions<K>::contacts(double t, const double* u) const {
  std::vector<ContactReport> reports;
  rigid_contact_->add_reports(t, u, reports);
  body_contact_->add_reports(u, reports);
  return reports;
}

template <Kinematics K>
std::vector<Intrusion> Conditions<K>::intrusions(const Parts& phase, double t, const double* u) const {
  std::vector<Intrusion> found = body_contact_->intrusions(u);
  if (!rigid_contact_->empty()) std::ranges::move(rigid_contact_->intrusions(phase, t, u), std::back_inserter(found));
  return found;
}

template <Kinematics K>
bool Conditions<K>::rigid_bodies_jump(double before, double t) const {
  return way_of_rigid_bodies(before, t) > RigidContact<K>::jump;
}

template <Kinematics K>
double Conditions<K>::way_of_rigid_bodies(double before, double t) const {
  return rigid_contact_->empty() ? 0 : rigid_contact_->longest_way(before, t);
}

template <Kinematics K>
std::vector<Intrusion> Conditions<K>::passages(const Parts& phase, double before, double t, const double* u) const {
  return rigid_contact_->passages(phase, before, t, u);
}

template <Kinematics K>
RigidFaces<K> Conditions<K>::faces_of_rigid_bodies(double t, const double* u) const {
  return rigid_contact_->faces(t, u);
}

template <Kinematics K>
bool Conditions<K>::is_ahead(std::size_t body, const Point<dim>& direction, double t, const double* u) const {
  return rigid_contact_->is_ahead(body, direction, t, u);
}

template <Kinematics K>
bool Conditions<K>::are_touched(double t, const double* u) const {
  return rigid_contact_->is_touched(t, u) || body_contact_->is_touched(u);
}

template <Kinematics K>
double Conditions<K>::friction_work() const {
  return rigid_contact_->friction_work() + body_contact_->friction_work();
}

template <Kinematics K>
ContactState Conditions<K>::contact_state(const Parts& phase, double t, const double* u) const {
  ContactFit fit(phase.dofs.size());
  rigid_contact_->add_fit(t, u, fit);
  body_contact_->add_fit(u, fit);
  return fit.state();
}

template <Kinematics K>
std::vector<char> Conditions<K>::are_sprung(std::size_t unknowns) const {
  std::vector<char> sprung(unknowns, 0);
  for (const Springs::Weight& weight : weak_supports_.springs().weights())
    sprung[static_cast<std::size_t>(weight.unknown)] = 1;
  return sprung;
}

template <Kinematics K>
bool Conditions<K>::ask_for_next_phase(ConstVec u) const {
  return std::ranges::any_of(all_, [u](const auto& condition) { return condition->asks_for_next_phase(u); });
}

template <Kinematics K>
void Conditions<K>::end_phase(double t, const double* u) {
  for (const auto& condition : all_) condition->end_phase(u);
  weak_supports_.end_phase(u, /*in_place=*/false);
  load_control_.end_phase(u, /*in_place=*/false);
  rigid_contact_->end_phase(t, u, /*in_place=*/false);
  body_contact_->end_phase(u, /*in_place=*/false);
  fading_.end_phase(u);
}

template <Kinematics K>
void Conditions<K>::end_phase_in_place(double t, const double* u) {
  weak_supports_.end_phase(u, /*in_place=*/true);
  load_control_.end_phase(u, /*in_place=*/true);
  rigid_contact_->end_phase(t, u, /*in_place=*/true);
  body_contact_->end_phase(u, /*in_place=*/true);
}

template <Kinematics K>
void Conditions<K>::archive(const StateArchive& state) {
  for (const auto& condition : all_) condition->archive(state.part(condition->kind()));
  weak_supports_.archive(state.part("weak_supports"));
  load_control_.archive(state.part("load"));
  rigid_contact_->archive(state.part("rigid"));
  body_contact_->archive(state.part("bodies"));
  if (problem_.phase.at_stages) fading_.archive(state.part("fading"));
}

template <Kinematics K>
void Conditions<K>::take_over(const SavedState& from_stage) {
  const auto state = StateArchive::restoring(from_stage);
  for (const auto& condition : all_)
    if (state.has_part(condition->kind())) condition->take_over(state.part(condition->kind()));
  weak_supports_.archive(state.part("weak_supports"));
  if (state.has_part("load")) load_control_.archive(state.part("load"));
  rigid_contact_->take_over(state.part("rigid"));
  body_contact_->take_over(state.part("bodies"));
}

template <Kinematics K>
void Conditions<K>::place_new_loads(const CarriedBodyOf<K>& carried, const Grid<dim>& grid) {
  const auto ways = ways_since_placed<K>(problem_, carried, grid);
  for (const auto& condition : all_) condition->leave_placed(*ways);
}

template <Kinematics K>
void Conditions<K>::leave_placed(const CarriedBodyOf<K>& carried, const Grid<dim>& grid) {
  const auto ways = ways_since_placed<K>(problem_, carried, grid);
  for (const auto& condition : all_) condition->leave_placed(*ways);
  load_control_.leave_placed(*ways);
  rigid_contact_->leave_placed(*ways);
  body_contact_->leave_placed(*ways);
}

template <Kinematics K>
std::vector<WallReaction> Conditions<K>::wall_reactions(double t) const {
  std::vector<WallReaction> reactions;
  for (const auto& condition : all_) condition->report(t, reactions);
  return reactions;
}

template <Kinematics K>
std::vector<double> Conditions<K>::support_displacements(const HeldUnknowns& held, double t) const {
  std::vector<double> moved;
  for (std::size_t s = 0; s < held.prescribed().size(); ++s) moved.push_back(held.displacement(s, t));
  for (const Springs* springs : {&weak_supports_.springs(), &load_control_.springs()}) {
    for (std::size_t s = 0; s < springs->size(); ++s)
      moved.push_back(springs->support_displacement(s, t, held.start()));
  }
  rigid_contact_->add_displacements(t, moved);
  return moved;
}

template <Kinematics K>
bool Conditions<K>::name_supports() const {
  return std::ranges::any_of(problem_.supports, [](const SupportSpec& support) { return !support.name.empty(); });
}

template class Conditions<Kinematics::line>;
template class Conditions<Kinematics::plane>;
template class Conditions<Kinematics::axisymmetric>;
template class Conditions<Kinematics::space>;

}  // namespace stillpoint
