// The tables of a scene, from the files that hold their rows. The catalogue must outlive them.
#pragma once

#include <stillpoint/catalogue.hpp>

#include <vector>

#include "scene/input/key_reader.hpp"

namespace stillpoint {

// What adds a table is one chain of hundreds of temporaries, whose scopes the address sanitizer would watch one by one:
// three minutes of the compiler's time, for no name that outlives them. Hence [[gnu::no_sanitize_address]].

/// [body], or several [[body]].
void add_body(Tables& tables);
/// [[support]], [[wall]], [[rigid]], [[contact]], [[force]], [[traction]], [body_force] and [load].
void add_boundary(Tables& tables);
/// [[rigid]] and [[contact]] alone.
void add_contact(Tables& tables);
/// [[stage]].
void add_stages(Tables& tables);
/// [solve], [damping], [integrator] and [stop].
void add_method(Tables& tables, const Catalogue& catalogue);
/// [output], [checkpoint], [[probe]] and [[variant]].
void add_output(Tables& tables);

/// A table of all materials, which reads them, and one for each law, which tells its keys.
std::vector<TableInfo> material_tables(const Catalogue& catalogue);
/// A table [exact], which reads it, and one for each solution, which tells its keys.
std::vector<TableInfo> exact_tables(const Catalogue& catalogue);

/// Computes every entry of [constants] into reading.constants; names of those that cannot be computed go into
/// reading.broken, with a problem.
void resolve_constants(const toml::table& table, Reading& reading);

}  // namespace stillpoint
