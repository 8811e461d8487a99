// The catalogue of all that this library offers, and the scenes that are read with it.
#include "plan/catalogue.hpp"

#include <stillpoint/damping.hpp>
#include <stillpoint/relaxation.hpp>
#include <stillpoint/scene.hpp>

#include <list>
#include <mutex>
#include <utility>
#include <vector>

#include "exact/known_solutions.hpp"
#include "scene/input/read_scene.hpp"
#include "solvers/statics/static_methods.hpp"
#include "space/materials/material_laws.hpp"

namespace stillpoint {
namespace {

// A catalogue, and which tables it is of: a program may have added to them since.
struct Edition {
  const std::vector<LawInfo>* laws;
  const std::vector<StrategyInfo>* dampings;
  const std::vector<RelaxationInfo>* relaxations;
  Catalogue catalogue;
};

Edition edition_of(const std::vector<LawInfo>& laws, const std::vector<StrategyInfo>& dampings,
                   const std::vector<RelaxationInfo>& relaxations) {
  Catalogue catalogue{
      .laws = laws, .strategies = dampings, .static_methods = static_methods(), .methods = {}, .solutions = {}};
  for (const KnownSolution& known : known_solutions()) catalogue.solutions.push_back(known.about);
  for (const RelaxationInfo& relaxation : relaxations) catalogue.strategies.push_back(relaxation.about);
  for (const Method& method : methods()) catalogue.methods.push_back(method);
  return {&laws, &dampings, &relaxations, std::move(catalogue)};
}

}  // namespace

const Catalogue& catalogue() {
  static std::mutex mutex;
  static std::list<Edition> editions;  // all of them, as rows of each are referred to
  const std::scoped_lock lock(mutex);
  const std::vector<LawInfo>& laws = material_laws();
  const std::vector<StrategyInfo>& forces = dampings();
  const std::vector<RelaxationInfo>& iterations = relaxations();
  if (editions.empty() || editions.back().laws != &laws || editions.back().dampings != &forces ||
      editions.back().relaxations != &iterations)
    editions.push_back(edition_of(laws, forces, iterations));
  return editions.back().catalogue;
}

Scene load_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return read_scene(file, overrides, catalogue());
}

Scene load_scene(const std::filesystem::path& file, const std::string& text,
                 const std::vector<std::string>& overrides) {
  return read_scene(file, text, file.string(), overrides, catalogue());
}

Problem resolve(Problem problem) { return resolved(std::move(problem), catalogue()); }

}  // namespace stillpoint
