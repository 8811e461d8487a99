#include "space/boundary/contact_surface.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include <Eigen/Core>

namespace stillpoint {
namespace {

/// Whether numbers are those at which parts of so many end, none of them empty.
bool are_ends(const std::vector<std::size_t>& ends, std::size_t of) {
  const bool ascend = std::ranges::adjacent_find(ends, std::ranges::greater_equal{}) == ends.end();
  return !ends.empty() && ascend && ends.front() > 0 && ends.back() == of;
}

}  // namespace

template <Kinematics K>
ContactSurface<K>::ContactSurface(const Problem& problem, const std::vector<char>& touched, const Grid<dim>& grid)
    : phases_end_(problem.phase.ends()) {
  const bool stretches = in_plane && problem.phase.ends() &&
                         problem.phase.quadrature != Quadrature::domains;  // as pieces that are carried
  for (std::size_t k = 0; k < problem.bodies.size(); ++k) {
    if (!touched[k]) continue;
    const std::vector<BorderPatch<K>> patches = border_patches<K>(problem, k, grid);
    if (stretches) add_chains(problem.bodies[k], patches);
    for (const BorderPatch<K>& patch : patches) {
      const std::size_t begin = pieces_.size();
      pieces_.insert(pieces_.end(), patch.pieces.begin(), patch.pieces.end());
      patches_.push_back({.body = k, .begin = begin, .end = pieces_.size(), .cell = patch.cell, .depth = patch.depth});
    }
  }
}

template <Kinematics K>
void ContactSurface<K>::add_chains(const BodySpec& body, const std::vector<BorderPatch<K>>& patches) {
  const int along = std::min(body.points_per_cell[0], body.points_per_cell[1]);
  const double longest = std::min(1.2, 1.5 / along);  // [cells]: they begin 1/along apart
  for (std::size_t k = 0; k < patches.size();) {
    std::size_t end = k + 1;
    while (end < patches.size() && patches[end].goes_on) ++end;
    const std::array<FaceEnd, 2> ends = {patches[k].ends[0], patches[end - 1].ends[1]};
    chains_.push_back(
        {patches_.size() + k, patches_.size() + end, BorderChain<K>(patches[end - 1].closes, ends, longest)});
    k = end;
  }
}

template <Kinematics K>
void ContactSurface<K>::begin_phase(const Parts& phase, const StiffnessBound& stiffness_bound) {
  if (empty()) return;
  freeze(phase);
  take_weights(phase, nullptr);
  take_functions();
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
  constexpr double beta = 1;
  for (Patch& patch : patches_) {
    double sum = 0, area = 0;
    for (std::size_t s = patch.begin; s < patch.end; ++s) {
      StiffnessAt at;
      for (std::size_t e = begin_[s]; e < begin_[s + 1]; ++e)
        if (const double bound = G[static_cast<std::size_t>(weights_[e].first_unknown / dim)]; bound > 0)
          at.add(weights_[e].w, bound);
      if (at.compliance > 0) sum += area_[s] * beta * at.ww / at.compliance;
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
void ContactSurface<K>::end_phase(const double* u) {
  for (BorderPiece<K>& piece : pieces_) piece.move(u);
}

template <Kinematics K>
std::vector<PieceOrigin> ContactSurface<K>::cut_anew() {
  std::vector<PieceOrigin> origins;
  if constexpr (in_plane) {
    using LinkedPatch = typename BorderChain<K>::LinkedPatch;
    std::vector<std::vector<LinkedPatch>> cut;
    bool changed = false;
    for (const Chain& chain : chains_) {
      std::vector<LinkedPatch>& patches = cut.emplace_back();
      for (std::size_t k = chain.begin; k < chain.end; ++k) {
        patches.push_back({patches_[k].cell, patches_[k].depth, {}});
        for (std::size_t s = patches_[k].begin; s < patches_[k].end; ++s) patches.back().links.push_back(link(k, s));
      }
      changed = chain.chain.cut(patches) || changed;
    }
    std::vector<BorderPiece<K>> pieces;
    std::vector<Patch> patches;
    for (std::size_t c = 0; c < chains_.size(); ++c) {
      const std::size_t begin = patches.size();
      for (const LinkedPatch& linked : cut[c]) {
        Patch patch = patches_[linked.links.front().origin.patch[0]];
        patch.begin = pieces.size(), patch.stiffness = 0;
        for (const auto& [piece, length, origin] : linked.links) {
          pieces.push_back(piece), origins.push_back(origin);
          for (const std::size_t before : origin.patch)
            patch.stiffness += patches_[before].stiffness / static_cast<double>(2 * linked.links.size());
        }
        patch.end = pieces.size();
        patches.push_back(patch);
      }
      if (changed) chains_[c].begin = begin, chains_[c].end = patches.size();
    }
    if (!chains_.empty()) pieces_ = std::move(pieces);
    if (!changed) return {};
    patches_ = std::move(patches);
  }
  return origins;
}

// With its undeformed length along the border.
template <Kinematics K>
auto ContactSurface<K>::link(std::size_t patch, std::size_t s) const -> typename BorderChain<K>::Link {
  const BorderPiece<K>& piece = pieces_[s];
  const double depth = K == Kinematics::axisymmetric ? 2 * std::numbers::pi * piece.X[0] : patches_[patch].depth;
  return {piece, piece.area / depth, {{s, s}, {patch, patch}}};
}

// Of chains the numbers of patches and pieces are part of the state.
template <Kinematics K>
void ContactSurface<K>::archive(const StateArchive& state) {
  if (empty()) return;
  if (!chains_.empty()) archive_numbers(state);
  state.each(
      "positions", pieces_, [](BorderPiece<K> & piece) -> auto& { return piece.at.x; });
  state.each(
      "areas", pieces_, [](BorderPiece<K> & piece) -> auto& { return piece.vector; });
  std::vector<double> stiffness;
  for (const Patch& patch : patches_) stiffness.push_back(patch.stiffness);
  state("stiffness", Vec(stiffness));
  for (std::size_t k = 0; k < patches_.size(); ++k) patches_[k].stiffness = stiffness[k];
}

template <Kinematics K>
void ContactSurface<K>::archive_numbers(const StateArchive& state) {
  std::vector<std::size_t> ends_of_chains, ends;
  std::vector<double> lengths;  // undeformed areas, and X
  for (const Chain& chain : chains_) ends_of_chains.push_back(chain.end);
  for (const Patch& patch : patches_) ends.push_back(patch.end);
  state("chains", ends_of_chains, "patches", ends);
  if (state.restores()) {
    if (ends_of_chains.size() != chains_.size() || !are_ends(ends_of_chains, ends.size()) || ends.empty() ||
        !are_ends(ends, ends.back()))
      throw StateError("'chains' and 'patches' are not those of a border");
    std::vector<Patch> patches;
    for (Chain& chain : chains_) {
      const Patch like = patches_[chain.begin];
      chain.begin = patches.size(), chain.end = ends_of_chains[static_cast<std::size_t>(&chain - chains_.data())];
      for (std::size_t k = chain.begin; k < chain.end; ++k) {
        patches.push_back(like);
        patches[k].begin = k == 0 ? 0 : ends[k - 1], patches[k].end = ends[k];
      }
    }
    patches_ = std::move(patches);
    pieces_.resize(ends.back(), pieces_.front());
  }
  state.each(
      "undeformed", pieces_, [](BorderPiece<K> & piece) -> auto& { return piece.X; });
  for (const BorderPiece<K>& piece : pieces_) lengths.push_back(piece.area);
  for (const Patch& patch : patches_) lengths.push_back(patch.cell), lengths.push_back(patch.depth);
  state("sizes", Vec(lengths));
  auto from = lengths.begin();
  for (BorderPiece<K>& piece : pieces_) piece.area = *from++;
  for (Patch& patch : patches_) patch.cell = *from++, patch.depth = *from++;
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
