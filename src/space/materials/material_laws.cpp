#include "space/materials/material_laws.hpp"

#include <stillpoint/drucker_prager_cone.hpp>
#include <stillpoint/own_history_law.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "base/registry.hpp"
#include "base/text.hpp"
#include "space/materials/umat.hpp"

namespace stillpoint {
namespace {

/// What makes a law that a program has added: one of these is empty.
struct OfStates {
  std::map<StressState, MakeLaw> elastic{};
  std::map<StressState, MakeHistoryLaw> with_history{};

  bool is_built_in() const { return elastic.empty() && with_history.empty(); }
};

constexpr const char* fluidity = "fluidity";

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr ParameterInfo positive(std::string_view name, std::string_view unit, std::string_view meaning) {
  return {name, unit, meaning, 0, infinity, false, true, 0};
}
constexpr ParameterInfo optional(std::string_view name, std::string_view unit, std::string_view meaning, double upper,
                                 double fallback) {
  return {name, unit, meaning, 0, upper, true, false, fallback};
}
constexpr ParameterInfo same_as(std::string_view other, ParameterInfo parameter) {
  parameter.same_as = other;
  parameter.fallback = std::numeric_limits<double>::quiet_NaN();
  return parameter;
}

constexpr ParameterInfo by_place(ParameterInfo parameter) {
  parameter.by_place = true;
  return parameter;
}

constexpr ParameterInfo without_default(ParameterInfo parameter) {
  parameter.required = false;
  parameter.fallback = std::numeric_limits<double>::quiet_NaN();
  return parameter;
}

std::optional<LawFault> fault_of_cam_clay(const MaterialSpec& material) {
  const auto value = [&](const char* name) { return material.parameters.at(name); };
  if (!(value("kappa") < value("lambda")))
    return LawFault{"kappa", fmt::format("must be below lambda = {}, not {}", value("lambda"), value("kappa"))};
  const bool by_OCR = !std::isnan(value("OCR")), by_pc = !std::isnan(value("pc"));
  if (by_OCR && by_pc) return LawFault{"pc", "give either OCR or pc, not both"};
  if (!by_OCR && !by_pc) return LawFault{"law", "'cam-clay' needs OCR or pc: how far it was pressed before"};
  if (material.undrained && !material.water_modulus)
    return LawFault{"undrained", "needs water_modulus with 'cam-clay', whose own stiffness follows the stress"};
  return std::nullopt;
}

constexpr ParameterInfo youngs_modulus = by_place(positive("E", "Pa", "Young's modulus"));
constexpr ParameterInfo poissons_ratio{"nu", "1", "Poisson's ratio", -1, 0.5, false, false, 0};
// A strongly auxetic neo-Hookean section has no unique lateral stretch in compression.
constexpr ParameterInfo neo_hookean_poissons_ratio{"nu", "1", "Poisson's ratio", -0.2, 0.5, false, false, 0};
constexpr ParameterInfo density = by_place(positive("rho", "kg/m3", "density"));

std::vector<std::string_view> cone_names() {
  std::vector<std::string_view> names;
  for (const auto& [name, cone] : cone_words) names.push_back(name);
  return names;
}

// The laws of this library.
std::vector<LawInfo> built_in() {
  using enum StressState;
  static const std::vector<StressState> all = {uniaxial_stress, uniaxial_strain, plane_strain,
                                               plane_stress,    axisymmetric,    space};
  return {
      {"linear-elastic",
       "sigma = lambda tr(eps) I + 2 mu eps, small strain",
       "Hooke's law",
       all,
       {youngs_modulus, poissons_ratio, density},
       {},
       /*history_dependent=*/false,
       /*finite_strain=*/false},
      {"neo-hookean",
       "W = mu/2 (tr C - 3 - 2 ln J) + lambda/2 (ln J)^2, finite strain",
       "Bonet and Wood 2008, eq. 6.27",
       all,
       {youngs_modulus, neo_hookean_poissons_ratio, density},
       {}},
      {"hencky",
       "W = mu tr(e^2) + lambda/2 (tr e)^2, e = 1/2 ln(F F^T), finite strain",
       "Anand 1979",
       all,
       {youngs_modulus, poissons_ratio, density},
       {}},
      {"drucker-prager",
       "sqrt(J2) + eta p - xi c <= 0, flow by sqrt(J2) + eta_bar p, tension cut-off with a gap, finite strain",
       "de Souza Neto, Peric and Owen 2008, section 8.3",
       {plane_strain, axisymmetric, space},
       {youngs_modulus, poissons_ratio, density, optional("phi", "degrees", "angle of internal friction", 90, 0),
        optional("psi", "degrees", "angle of dilatancy", 90, 0), by_place(optional("c", "Pa", "cohesion", infinity, 0)),
        optional(fluidity, "1/(Pa s)", "Perzyna's beta; 0: rate-independent", infinity, 0),
        optional("tension", "Pa", "largest mean stress; never above the apex", infinity, infinity),
        same_as("phi", optional("phi_residual", "degrees", "phi after softening", 90, 0)),
        same_as("c", optional("c_residual", "Pa", "cohesion after softening", infinity, 0)),
        optional("softening_strain", "1", "plastic strain of full softening; 0: none", infinity, 0)},
       {{"cone", "match to Mohr-Coulomb", cone_names(), "plane-strain"}},
       /*history_dependent=*/true,
       /*finite_strain=*/true,
       /*softens_by_rows=*/false,
       /*has_strength=*/true},
      {"mohr-coulomb",
       "(s1 - s3) + (s1 + s3) sin(phi) - 2 c cos(phi) <= 0 of principal stresses, flow by psi, tension cut-off s1 <= "
       "tension, finite strain; Tresca for phi = 0",
       "Clausen, Damkilde and Andersen 2007",
       {plane_strain, axisymmetric, space},
       {youngs_modulus, poissons_ratio, density, by_place(optional("c", "Pa", "cohesion", infinity, 0)),
        optional("phi", "degrees", "angle of internal friction", 90, 0),
        optional("psi", "degrees", "angle of dilatancy", 90, 0),
        optional("tension", "Pa", "largest principal stress; never above the apex", infinity, infinity)},
       {},
       /*history_dependent=*/true,
       /*finite_strain=*/true,
       /*softens_by_rows=*/true,
       /*has_strength=*/true},
      {"cam-clay",
       "q^2/M^2 + p (p - pc) <= 0, associated flow, K = v p/kappa, dpc/pc = v/(lambda - kappa) of plastic volume "
       "strain; "
       "pressures positive; finite strain",
       "Roscoe and Burland 1968",
       {plane_strain, axisymmetric, space},
       {positive("M", "1", "q/p in the critical state"),
        positive("lambda", "1", "slope of the normal compression line, of v in ln p"),
        positive("kappa", "1", "slope of unloading, below lambda"),
        {"nu", "1", "Poisson's ratio", -1, 0.5, false, true, 0},
        density,
        by_place(positive("e0", "1", "void ratio at the start, v = 1 + e")),
        by_place(without_default({"OCR", "1", "overconsolidation ratio, in place of pc", 1, infinity, true, false, 0})),
        by_place(without_default(positive("pc", "Pa", "preconsolidation pressure at the start")))},
       {ChoiceInfo{"volume", "the v of the stiffnesses: of now, or 1 + e0", {"evolves", "fixed"}, "evolves"}},
       /*history_dependent=*/true,
       /*finite_strain=*/true,
       /*softens_by_rows=*/false,
       /*has_strength=*/false,
       /*needs_pressure=*/true,
       /*fields=*/{},
       /*from_library=*/false,
       &fault_of_cam_clay},
      {.name = "umat",
       .equation = "an Abaqus UMAT from a shared library, finite strain",
       .source = "the user's own",
       .states = {plane_strain, axisymmetric, space},
       .parameters = {density},
       .history_dependent = true,
       .from_library = true,
       .fault = &fault_of_umat},
  };
}

// The laws of this library are compiled in: there is nothing that makes them.
Registry<LawInfo, OfStates>& registry() {
  static Registry<LawInfo, OfStates> laws([] {
    std::vector<Registry<LawInfo, OfStates>::Row> rows;
    for (const LawInfo& law : built_in()) rows.push_back({law, {}});
    return rows;
  }());
  return laws;
}

void check_parameters(const OwnLaw& about) {
  std::set<std::string> taken = {"law", "rho"};
  for (const OwnParameter& parameter : about.parameters) {
    if (parameter.name.empty() || !taken.insert(parameter.name).second)
      throw std::invalid_argument(
          fmt::format("the law '{}' has two parameters '{}', or one without a name", about.name, parameter.name));
    if (!(parameter.lower < parameter.upper))
      throw std::invalid_argument(fmt::format("the parameter '{}' of the law '{}' has no value between {} and {}",
                                              parameter.name, about.name, parameter.lower, parameter.upper));
  }
}

LawInfo row_of(const OwnLaw& about, const OfStates& of_states, const std::set<std::string>& fields) {
  LawInfo info{kept_for_good(about.name), kept_for_good(about.equation), kept_for_good(about.source), {}, {}};
  info.history_dependent = !of_states.with_history.empty();
  for (const std::string& field : fields)
    if (!field.empty()) info.fields.push_back(kept_for_good(field));
  for (const auto& [state, make] : of_states.elastic) info.states.push_back(state);
  for (const auto& [state, make] : of_states.with_history) info.states.push_back(state);
  for (const OwnParameter& p : about.parameters)
    info.parameters.push_back({kept_for_good(p.name), kept_for_good(p.unit), kept_for_good(p.meaning), p.lower, p.upper,
                               false, !p.fallback, p.fallback.value_or(0)});
  info.parameters.push_back(density);
  return info;
}

void put(const OwnLaw& about, const OfStates& of_states, const std::set<std::string>& fields = {}) {
  if (!is_plain_word(about.name))
    throw std::invalid_argument(
        fmt::format("a law cannot be called '{}'; expected {}", about.name, what_a_plain_word_is));
  if (of_states.is_built_in()) throw std::invalid_argument(fmt::format("the law '{}' has no stress state", about.name));
  check_parameters(about);
  const auto& laws = registry().infos();
  const bool is_known = std::ranges::find(laws, about.name, &LawInfo::name) != laws.end();
  if (is_known && registry().maker(about.name).is_built_in())
    throw std::invalid_argument(fmt::format("'{}' is a law of this library; expected another name", about.name));
  registry().put(row_of(about, of_states, fields), of_states);
}

}  // namespace

const std::vector<LawInfo>& material_laws() { return registry().infos(); }

// A user-defined law may have a parameter of this name.
bool is_viscous(const MaterialSpec& material) {
  const auto law = std::ranges::find(material_laws(), material.law, &LawInfo::name);
  const auto beta = material.parameters.find(fluidity);
  return law != material_laws().end() && law->history_dependent && beta != material.parameters.end() &&
         beta->second > 0 && registry().maker(material.law).is_built_in();
}

MaterialSpec rate_independent(MaterialSpec material) {
  if (is_viscous(material)) material.parameters[fluidity] = 0;
  return material;
}

// The displacement across a band, γ l = γ_h h, is what softens it.
MaterialSpec with_bands_of(MaterialSpec material, double cell) {
  if (!material.softening_length) return material;
  const double wider = *material.softening_length / cell;
  for (StrengthRow& row : material.softening) row.plastic_strain *= wider;
  if (const auto strain = material.parameters.find("softening_strain"); strain != material.parameters.end())
    strain->second *= wider;
  return material;
}

void add_law(const OwnLaw& about, const std::map<StressState, MakeLaw>& of_states) {
  put(about, {.elastic = of_states});
}

void add_history_law(const OwnLaw& about, const std::vector<std::string>& fields,
                     const std::map<StressState, MakeHistoryLaw>& of_states) {
  put(about, {.with_history = of_states}, {fields.begin(), fields.end()});
}

std::shared_ptr<const LawAnswers> own_law_answers(const std::string& law, StressState state,
                                                  const LawParameters& parameters) {
  const OfStates of_states = registry().maker(law);
  return of_states.elastic.empty() ? nullptr : of_states.elastic.at(state)(parameters);
}

std::shared_ptr<const HistoryAnswers> own_history_answers(const std::string& law, StressState state,
                                                          const LawParameters& parameters) {
  const OfStates of_states = registry().maker(law);
  return of_states.with_history.empty() ? nullptr : of_states.with_history.at(state)(parameters);
}

}  // namespace stillpoint
