// Numbers of a scene that are likely to be in other units, of another sign or at another time than is meant.
#pragma once

#include <stillpoint/problem.hpp>

#include <string>
#include <vector>

namespace stillpoint {

/// Notes on angles that look like radians, densities that no solid has in SI units, gravity that points up, and fields
/// that are asked for after the end.
std::vector<std::string> unit_notes(const Problem& problem);

}  // namespace stillpoint
