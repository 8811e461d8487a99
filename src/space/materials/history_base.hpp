// The committed history of a material's points: what laws with a history share, whether their history has a size that
// is known when they are compiled or one that is known as they run.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "space/materials/law_material.hpp"

namespace stillpoint {

/// Base class of HistoryMaterial and OwnHistoryMaterial. A trial does not change the committed history; committing
/// swaps the two.
template <class Law>
class HistoryBase : public LawMaterialBase<Law> {
  using Base = LawMaterialBase<Law>;

 protected:
  using Base::begin_, Base::count_;
  using typename Base::Block, typename Base::Stresses;

 public:
  void keep_history(const Block& block, double* trial) const override {
    for (std::size_t h = 0; h < rows_; ++h)
      std::copy_n(committed_at(block.first) + count_ * h, block.count, trial_at(trial, block.first) + count_ * h);
  }
  void commit(std::vector<double>& trial) override { committed_.swap(trial); }
  void end_phase(const Block&) override {}
  Vec memory() override { return committed_; }
  void reorder(const Reordering& order, std::vector<double>& work) override {
    order.apply(committed_, work, begin_, count_);
  }
  std::size_t memory_rows() const override { return rows_; }
  void replace(std::vector<double> memory, std::size_t begin, std::size_t count) override {
    committed_ = std::move(memory);
    begin_ = begin;
    count_ = count;
    this->set_history_size(rows_ * count);
  }
  void set_stress(const std::vector<Stresses>& stress, const InitialGround& ground) override {
    std::vector<double> of_point(rows_);
    for (std::size_t k = 0; k < count_; ++k) {
      write_initial(stress[k], ground.at(k), of_point.data());
      for (std::size_t h = 0; h < rows_; ++h) committed_[count_ * h + k] = of_point[h];
    }
  }

  double pore_pressure(const TensorOf<kinematics(Law::state)>&, std::size_t p) const override {
    for (std::size_t h = 0; h < rows_; ++h)
      if (name_of(h) == "pore_pressure") return committed_[count_ * h + p - begin_];
    return 0;
  }

  std::vector<PointArray> arrays() const override {
    const double bytes = static_cast<double>(rows_) * Base::real;
    return {{"history, committed", bytes}, {"history, trial", bytes}};
  }
  std::vector<std::pair<std::string, ConstVec>> shown_history() const override {
    std::vector<std::pair<std::string, ConstVec>> shown;
    for (std::size_t h = 0; h < rows_; ++h) {
      if (const std::string_view name = name_of(h); !name.empty())
        shown.emplace_back(name, ConstVec(committed_).subspan(count_ * h, count_));
    }
    return shown;
  }

 protected:
  HistoryBase(const Law& law, std::size_t begin, std::size_t count, PointMaterialInfo info, std::size_t rows)
      : Base(law, begin, count, with_size(info, rows * count)), rows_(rows), committed_(rows * count) {}

  /// Writes the history of a point under this stress, (rows).
  virtual void write_initial(const Stresses& stress, const InitialPoint& point, double* history) const = 0;
  /// The name of a row for users; empty: it is not shown.
  virtual std::string_view name_of(std::size_t row) const = 0;

  /// The first row of the points from this one on; the next row is count_ entries away.
  [[gnu::always_inline]] const double* committed_at(std::size_t point) const {
    return committed_.data() + point - begin_;
  }
  [[gnu::always_inline]] double* trial_at(double* trial, std::size_t point) const { return trial + point - begin_; }
  /// Copies the committed history of a point.
  void read(std::size_t point, double* history) const {
    for (std::size_t h = 0; h < rows_; ++h) history[h] = committed_[count_ * h + point - begin_];
  }
  /// The row of all points.
  Vec row(std::size_t h) { return Vec(committed_).subspan(count_ * h, count_); }
  std::size_t rows() const { return rows_; }

 private:
  static PointMaterialInfo with_size(PointMaterialInfo info, std::size_t size) {
    info.history_dependent = true;
    info.finite_strain = true;
    info.history_size = size;
    return info;
  }

  std::size_t rows_;
  std::vector<double> committed_;  // (rows × points)
};

}  // namespace stillpoint
