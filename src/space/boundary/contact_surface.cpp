#include "space/boundary/contact_surface.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Core>
#include <fmt/format.h>

namespace stillpoint {
namespace {

bool is_on_smooth_way_to_rest(const Problem& problem) {
  return problem.stop.wants_equilibrium() && !loads_vary(problem) && !problem.rubs() && !problem.solve.is_static();
}

}  // namespace

template <Kinematics K>
ContactSurface<K>::ContactSurface(const Problem& problem, const std::vector<char>& touched, const Grid<dim>& grid)
    : phases_end_(problem.phase.ends()), beta_(is_on_smooth_way_to_rest(problem) ? 0.5 : 1) {
  for (const Axis& axis : grid.axes) extent_ = std::hypot(extent_, axis.max() - axis.min());
  const bool stretches = dim == 2 && problem.phase.ends() &&
                         problem.phase.quadrature != Quadrature::domains;  // as pieces that are carried
  for (std::size_t k = 0; k < problem.bodies.size(); ++k) {
    number_of_body_.push_back(problem.bodies[k].number);
    has_stiffness_.push_back(0);
    if (!touched[k]) continue;
    const std::vector<BorderPatch<K>> patches = border_patches<K>(problem, k, grid);
    if (stretches) chains_.add(problem.bodies[k], patches, patches_.size());
    const bool are_domains = problem.phase.ends() && problem.phase.quadrature == Quadrature::domains;
    int cell = -1;  // of the patch before
    for (const BorderPatch<K>& patch : patches) {
      const bool is_same = patch.of_cell == std::exchange(cell, patch.of_cell) && patch.goes_on;
      if (are_domains) group_.push_back(group_.empty() ? 0 : group_.back() + (is_same ? 0 : 1));
      const std::size_t begin = pieces_.size();
      pieces_.insert(pieces_.end(), patch.pieces.begin(), patch.pieces.end());
      patches_.push_back({.body = k, .begin = begin, .end = pieces_.size(), .cell = patch.cell, .depth = patch.depth});
    }
  }
}

template <Kinematics K>
void ContactSurface<K>::begin_phase(const Parts& phase, const StiffnessBound& stiffness_bound) {
  if (empty()) return;
  freeze(phase);
  take_weights(phase, nullptr);
  take_functions();
  neighbours_.find<K>(patches_, pieces_, group_);
  is_of_small_strain_ = phase.is_of_small_strain;
  if (!has_begun_) choose_stiffness(stiffness_bound());
  has_begun_ = true;
}

template <Kinematics K>
void ContactSurface<K>::freeze(const Parts& phase) {
  for (const Patch& patch : patches_)
    for (std::size_t s = patch.begin; s < patch.end; ++s) pieces_[s].at.field = phase.points.field_of(patch.body);
  if (phases_end_) {
    freeze_carried(
        pieces_, [](BorderPiece<K> & piece) -> auto& { return piece.at; }, !has_begun_, phase);
    return;
  }
  for (BorderPiece<K>& piece : pieces_)
    if (!piece.freeze_in_single_phase(phase)) piece.at.entries.clear();
}

template <Kinematics K>
void ContactSurface<K>::take_weights(const Parts& phase, const Partners* partners) {
  free_ = static_cast<int>(phase.dofs.size());
  area_.clear(), weights_.clear(), sources_.clear();
  begin_.assign(1, 0), sources_begin_.assign(1, 0);
  const auto take = [&](const Entry& a, double w) {
    if (a.function < 0 || w == 0) return;
    weights_.push_back({dim * a.function, w});
    for (int i = 0; i < dim; ++i) {
      phase.dofs.for_sources(dim * a.function + i, [&](int, int dof, double share) {
        const auto first = sources_.begin() + static_cast<std::ptrdiff_t>(sources_begin_.back());
        const auto known = std::find_if(first, sources_.end(), [&](const Source& one) { return one.dof == dof; });
        if (known == sources_.end()) {
          sources_.push_back({i, dof, w * share});
        } else {
          known->w += w * share;
        }
      });
    }
  };
  for (std::size_t s = 0; s < pieces_.size(); ++s) {
    area_.push_back(pieces_[s].size());
    for (const Entry& a : pieces_[s].at.entries) take(a, a.w);
    if (partners)
      for (const Entry& a : (*partners)[s]) take(a, -a.w);
    begin_.push_back(weights_.size());
    sources_begin_.push_back(sources_.size());
  }
}

template <Kinematics K>
void ContactSurface<K>::take_functions() {
  functions_.clear(), of_patches_.clear();
  for (const Weight& weight : weights_) functions_.push_back(weight.first_unknown);
  std::ranges::sort(functions_);
  functions_.erase(std::unique(functions_.begin(), functions_.end()), functions_.end());
  for (Patch& patch : patches_) {
    patch.first_function = of_patches_.size();
    patch.weight = 0;
    for (std::size_t s = patch.begin; s < patch.end; ++s) {
      double sum = 0;
      for (std::size_t e = begin_[s]; e < begin_[s + 1]; ++e) {
        sum += std::abs(weights_[e].w);
        of_patches_.push_back(
            static_cast<int>(std::ranges::lower_bound(functions_, weights_[e].first_unknown) - functions_.begin()));
      }
      patch.weight = std::max(patch.weight, sum);
    }
    const auto first = of_patches_.begin() + static_cast<std::ptrdiff_t>(patch.first_function);
    std::sort(first, of_patches_.end());
    of_patches_.erase(std::unique(first, of_patches_.end()), of_patches_.end());
    patch.end_function = of_patches_.size();
  }
}

template <Kinematics K>
void ContactSurface<K>::choose_stiffness(const std::vector<double>& G) {
  for (Patch& patch : patches_) {
    if (has_stiffness_[patch.body]) continue;
    double sum = 0, area = 0;
    for (std::size_t s = patch.begin; s < patch.end; ++s) {
      StiffnessAt at;
      for (std::size_t e = begin_[s]; e < begin_[s + 1]; ++e)
        if (const double bound = G[static_cast<std::size_t>(weights_[e].first_unknown / dim)]; bound > 0)
          at.add(weights_[e].w, bound);
      if (at.compliance > 0) sum += area_[s] * beta_ * at.ww / at.compliance;
      area += area_[s];
    }
    const double of_cell = patch.depth * std::pow(patch.cell, dim - 1);
    patch.stiffness = area > 0 ? sum / area / of_cell : 0;
  }
}

template <Kinematics K>
void ContactSurface<K>::add_product_held(const double* du, Vec dR) const {
  for (const Patch& patch : patches_) {
    for (std::size_t s = patch.begin; s < patch.end; ++s) {
      Point<dim> f = motion(s, du);
      for (double& along : f) along *= area_[s] * patch.stiffness;
      add(s, f, dR, {});
    }
  }
}

template <Kinematics K>
void ContactSurface<K>::add_entries_held(MatrixEntries& entries) const {
  using Matrix = Eigen::Matrix<double, dim, dim>;
  for (const Patch& patch : patches_)
    for (std::size_t s = patch.begin; s < patch.end; ++s)
      add_entries(s, Matrix(area_[s] * patch.stiffness * Matrix::Identity()), entries);
}

template <Kinematics K>
void ContactSurface<K>::put_in_series(double stiffness) {
  for (Patch& patch : patches_)
    if (patch.stiffness > 0 && stiffness > 0) patch.stiffness = 1 / (1 / patch.stiffness + 1 / stiffness);
}

template <Kinematics K>
double ContactSurface<K>::mean_stiffness() const {
  double sum = 0, area = 0;
  for (const Patch& patch : patches_) {
    for (std::size_t s = patch.begin; s < patch.end; ++s) {
      sum += area_[s] * patch.stiffness;
      area += area_[s];
    }
  }
  return area > 0 ? sum / area : 0;
}

template <Kinematics K>
void ContactSurface<K>::take_growth(const Parts& phase) {
  const double bound = bound_of_frequency(phase);
  if (first_bound_ < 0) first_bound_ = bound;
  growth_ = first_bound_ > 0 ? std::max(1.0, bound / first_bound_) : 1;
}

template <Kinematics K>
void ContactSurface<K>::end_phase(const double* u, bool in_place) {
  for (BorderPiece<K>& piece : pieces_) {
    if (in_place) {
      piece.move_in_place(u);
    } else {
      piece.move(u);
    }
  }
}

template <Kinematics K>
void ContactSurface<K>::leave_placed(const WaysSincePlaced<dim>& ways) {
  for (const Patch& patch : patches_) {
    for (std::size_t s = patch.begin; s < patch.end; ++s)
      if (const auto way = ways.at(patch.body, pieces_[s].X)) pieces_[s].leave_placed(*way, ways.in_place());
  }
  if (!ways.in_place()) cut_anew();
}

template <Kinematics K>
auto ContactSurface<K>::parts() const -> std::vector<Part> {
  std::vector<Part> parts;
  for (std::size_t k = 0; k < patches_.size(); ++k) {
    const Patch& patch = patches_[k];
    if (parts.empty() || parts.back().body != patch.body)
      parts.push_back({patch.body, number_of_body_[patch.body], k, k, patch.begin, patch.begin});
    parts.back().end_patch = k + 1;
    parts.back().end_piece = patch.end;
  }
  return parts;
}

template <Kinematics K>
std::string ContactSurface<K>::name_of(const Part& part) {
  return fmt::format("body_{}", part.number);
}

template <Kinematics K>
void ContactSurface<K>::take_over(const StateArchive& state) {
  for (const Part& part : parts()) has_stiffness_[part.body] = static_cast<char>(state.has_part(name_of(part)));
  archive_parts(state, /*some_are_new=*/true);
}

template <Kinematics K>
void ContactSurface<K>::archive_parts(const StateArchive& state, bool some_are_new) {
  std::vector<BorderPiece<K>> pieces;
  std::vector<Patch> patches;
  std::vector<std::size_t> ends_of_chains;
  for (const Part& part : parts()) {
    const auto slice = [](const auto& all, std::size_t begin, std::size_t end) {
      return std::vector(all.begin() + static_cast<std::ptrdiff_t>(begin),
                         all.begin() + static_cast<std::ptrdiff_t>(end));
    };
    BorderOfBody<K> border{slice(pieces_, part.first_piece, part.end_piece),
                           slice(patches_, part.first_patch, part.end_patch),
                           chains_.ends(part.first_patch, part.end_patch)};
    for (Patch& patch : border.patches) patch.begin -= part.first_piece, patch.end -= part.first_piece;
    const bool is_new = some_are_new && !state.has_part(name_of(part));
    if (!is_new) border.archive(state.part(name_of(part)));
    for (const std::size_t end : border.ends_of_chains) ends_of_chains.push_back(patches.size() + end);
    for (Patch& patch : border.patches) patch.begin += pieces.size(), patch.end += pieces.size();
    pieces.insert(pieces.end(), border.pieces.begin(), border.pieces.end());
    patches.insert(patches.end(), border.patches.begin(), border.patches.end());
  }
  if (!state.restores()) return;
  pieces_ = std::move(pieces);
  patches_ = std::move(patches);
  chains_.take_ends(ends_of_chains);
}

// The bound max_a κ_a/m_a, κ_a = Σ_s A_s κ |w_sa| Σ_b |w_sb|, on how much all pieces together add to ω_max² [1/s²]; 0
// unless the mass is lumped.
template <Kinematics K>
double ContactSurface<K>::bound_of_frequency(const Parts& phase) const {
  if (!phase.mass.is_lumped()) return 0;
  std::vector<double> kappa(static_cast<std::size_t>(free_), 0.0);
  for (const Patch& patch : patches_) {
    for (std::size_t s = patch.begin; s < patch.end; ++s) {
      double sum = 0;  // Σ_b |w_sb|
      for (std::size_t e = begin_[s]; e < begin_[s + 1]; ++e) sum += std::abs(weights_[e].w);
      for_free(s, [&](int, int dof, double w) {
        kappa[static_cast<std::size_t>(dof)] += area_[s] * patch.stiffness * std::abs(w) * sum;
      });
    }
  }
  double most = 0;
  for (std::size_t i = 0; i < kappa.size(); ++i) most = std::max(most, kappa[i] / phase.mass.diagonal()[i]);
  return most;
}

template class ContactSurface<Kinematics::line>;
template class ContactSurface<Kinematics::plane>;
template class ContactSurface<Kinematics::axisymmetric>;
template class ContactSurface<Kinematics::space>;

}  // namespace stillpoint
