// Checks of the materials: parameters that go together, the water in their pores, names of state variables.
#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/input/scene_check.hpp"
#include "scene/pore_water.hpp"

namespace stillpoint {
namespace {

/// A material that dilates more than it rubs would create energy.
void check_dilation(SceneCheck& check, const MaterialSpec& material) {
  constexpr const char* fault = "must be at most phi = {}, not {}";
  const auto phi = material.parameters.find("phi"), psi = material.parameters.find("psi");
  if (phi == material.parameters.end() || psi == material.parameters.end()) return;
  check.wrong_if(psi->second > phi->second, fmt::format("material.{}.psi", material.name), fault, phi->second,
                 psi->second);
  for (std::size_t k = 0; k < material.softening.size(); ++k) {
    const StrengthRow& row = material.softening[k];
    check.wrong_if(row.psi > row.phi, fmt::format("material.{}.softening[{}][3]", material.name, k), fault, row.phi,
                   row.psi);
  }
}

/// Water fills the pores of all directions: a side that is free to contract would need a law of its own.
void check_change_of_volume(SceneCheck& check, const std::string& key, bool is_elastic) {
  using enum StressState;
  std::vector<StressState> states = {plane_strain, axisymmetric, space};
  if (is_elastic) states.insert(states.begin(), uniaxial_strain);
  const std::string why = why_no_state("undrained ground", states, check.scene().state);
  check.wrong_if(!why.empty(), key, "{}", why);
}

void check_water(SceneCheck& check, const MaterialSpec& material) {
  const auto key = [&](const char* name) { return fmt::format("material.{}.{}", material.name, name); };
  for (const char* name : {"water_modulus", "porosity", "undrained_dilatancy"})
    check.wrong_if(!material.undrained && check.written(key(name)), key(name), "goes with undrained = true");
  check.wrong_if(material.undrained && check.written(key("porosity")) && !material.water_modulus, key("porosity"),
                 "goes with water_modulus");
  if (!material.undrained) return;
  const LawInfo* const law = check.catalogue().law(material.law);
  const bool is_elastic = law && !law->history_dependent;
  check_change_of_volume(check, key("undrained"), is_elastic);
  // The stress of an elastic law is proportional to E, with its water only if that is so as well.
  check.wrong_if(is_elastic && material.water_modulus && material.by_place.contains("E"), key("water_modulus"),
                 "does not go with an E that is a formula of the position: with '{}' water is as much stiffer as the "
                 "skeleton is; leave it out, for an undrained Poisson's ratio of 0.495 everywhere",
                 material.law);
  check.wrong_if(!is_elastic && !material.water_modulus && material.by_place.contains("E"), key("undrained"),
                 "needs a water_modulus beside an E that is a formula of the position");
  check.wrong_if(!material.water_modulus && !has_E_and_nu(material), key("undrained"),
                 "needs a water_modulus: with a law that has no E and nu there is no undrained Poisson's ratio");
  double psi = 0;
  if (const auto found = material.parameters.find("psi"); found != material.parameters.end()) psi = found->second;
  for (const StrengthRow& row : material.softening) psi = std::max(psi, row.psi);
  check.wrong_if(
      psi > 0 && !material.undrained_dilatancy, key("undrained"),
      "does not go with dilatancy, which would draw the water apart and make the ground stronger without end; "
      "expected psi = 0, not {}, or undrained_dilatancy = true",
      psi);
}

/// Names of state variables become fields and columns beside those that every body has.
void check_state_variables(SceneCheck& check, const MaterialSpec& material) {
  constexpr std::array taken = {"position",     "u", "v", "strain", "stress", "effective_stress", "volume",
                                "pore_pressure"};
  const auto fits = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  for (std::size_t k = 0; k < material.statev.size(); ++k) {
    const std::string& name = material.statev[k];
    const std::string key = fmt::format("material.{}.statev[{}]", material.name, k);
    if (name.empty()) continue;
    if (check.wrong_if(!std::ranges::all_of(name, fits) || std::isdigit(static_cast<unsigned char>(name[0])) != 0, key,
                       "{} cannot be the name of a field; expected letters, digits and '_', beginning with a letter",
                       in_quotes(name)))
      continue;
    check.wrong_if(std::ranges::find(taken, name) != taken.end(), key,
                   "there is a field {} already; expected another name", in_quotes(name));
    check.wrong_if(std::find(material.statev.begin(), material.statev.begin() + static_cast<std::ptrdiff_t>(k), name) !=
                       material.statev.begin() + static_cast<std::ptrdiff_t>(k),
                   key, "there are two state variables {}", in_quotes(name));
  }
}

void check_fault_of_law(SceneCheck& check, const MaterialSpec& material) {
  const LawInfo* const law = check.catalogue().law(material.law);
  if (!law || !law->fault || (law->from_library && material.library.empty())) return;
  const bool is_read = std::ranges::all_of(
      law->parameters, [&](const ParameterInfo& p) { return material.parameters.contains(std::string(p.name)); });
  if (!is_read) return;
  if (const auto fault = law->fault(material))
    check.add(fmt::format("material.{}.{}", material.name, fault->key), fault->message);
}

void check_softening(SceneCheck& check, const MaterialSpec& material) {
  const std::vector<StrengthRow>& rows = material.softening;
  const auto key = [&](const char* name) { return fmt::format("material.{}.{}", material.name, name); };
  const bool varies = material.by_place.contains("c");
  constexpr const char* why = "does not go with a cohesion that is a formula of the position";
  check.wrong_if(!rows.empty() && varies, key("softening"), why);
  check.wrong_if(varies && check.written(key("c_residual")), key("c_residual"), why);
  const auto strain = material.parameters.find("softening_strain");
  const bool softens = !rows.empty() || (strain != material.parameters.end() && strain->second > 0);
  check.wrong_if(material.softening_length && !softens, key("softening_length"),
                 "goes with softening, or softening_strain > 0");
  const auto volume = material.choices.find("volume");
  check.wrong_if(material.by_place.contains("e0") && volume != material.choices.end() && volume->second == "fixed",
                 key("e0"), "is a formula of the position, which goes with volume = \"evolves\"");
  check.wrong_if(rows.size() > most_strength_rows, fmt::format("material.{}.softening", material.name),
                 "has {} rows; expected at most {}", rows.size(), most_strength_rows);
  for (std::size_t k = 1; k < rows.size(); ++k)
    check.wrong_if(!(rows[k].plastic_strain > rows[k - 1].plastic_strain),
                   fmt::format("material.{}.softening[{}][0]", material.name, k),
                   "must be larger than {}, that of the row before, not {}", rows[k - 1].plastic_strain,
                   rows[k].plastic_strain);
}

}  // namespace

void check_materials(SceneCheck& check) {
  for (const auto& [name, material] : check.scene().materials) {
    check_dilation(check, material);
    check_softening(check, material);
    check_water(check, material);
    check_state_variables(check, material);
    check_fault_of_law(check, material);
  }
}

}  // namespace stillpoint
