// The part of history.csv that a report draws.
#pragma once

#include <filesystem>

#include "base/json.hpp"

namespace stillpoint {

/// {columns: […], rows: "t,steps,…\n…", of: number of all rows}, or null if there is no file. If there are more rows
/// than a report has room for, it has those at which some column is largest or smallest among its neighbours, so that
/// oscillating columns keep their envelope.
Json history_excerpt(const std::filesystem::path& history_csv);

}  // namespace stillpoint
