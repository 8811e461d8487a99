// Abaqus' user subroutine UMAT as a law with a history.
#pragma once

#include <stillpoint/catalogue.hpp>
#include <stillpoint/own_history_law.hpp>
#include <stillpoint/problem.hpp>

#include <memory>
#include <optional>

namespace stillpoint {

/// The law of a material's library in a stress state: plane_strain, axisymmetric or space. Throws std::domain_error if
/// the library cannot be used.
template <StressState S>
std::shared_ptr<const HistoryAnswers> make_umat(const MaterialSpec& material);

/// Finds what makes a material's library unusable.
std::optional<LawFault> fault_of_umat(const MaterialSpec& material);

}  // namespace stillpoint
