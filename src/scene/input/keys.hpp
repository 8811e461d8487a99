// The table of keys: every key of a scene once, with its type, range, unit, default and meaning. Reading a scene,
// `stillpoint list keys`, the reference in problems/README.md and the JSON schema all walk it.
#pragma once

#include <stillpoint/catalogue.hpp>
#include <stillpoint/scene.hpp>

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/input/toml_value.hpp"

namespace stillpoint {

/// The dimensions of the scenes in which there is a key or a word.
enum Dims : unsigned { kLine = 1, kPlane = 2, kSpace = 4, kNotLine = 6, kAnyDim = 7 };
constexpr Dims dims_of(int dim) { return static_cast<Dims>(1U << static_cast<unsigned>(dim - 1)); }

/// A word that a key takes; an option is its word's number in the list.
struct Word {
  Word(std::string_view word, Dims in = kAnyDim, bool by_number = true) : name(word), dims(in), has_number(by_number) {}
  Word(const char* word) : name(word) {}

  std::string_view name;
  Dims dims = kAnyDim;
  bool has_number = true;  // its number may be written in its place; words without a number come last
};

/// The names of a catalogue's rows.
std::vector<Word> names_of(const auto& rows) {
  std::vector<Word> words;
  for (const auto& row : rows) words.emplace_back(row.name);
  return words;
}

enum class Kind { number, whole, formula, text, truth };
/// axes: one value for each coordinate, if there is one a plain value; components: likewise for those of a stress or of
/// a turn.
enum class Shape { one, axes, components, list, positions, rows };

struct KeyInfo {
  Range range{};                 // the range of a number
  std::string_view unit{};       // the unit; empty: none
  std::vector<Word> words{};     // all values of a text; for a number, words that may be written in its place
  std::string_view variables{};  // the variables of a formula; x stands for all coordinates
  std::string fallback{};        // the default in words; empty: that of the member of Scene
  bool required = false;
  std::vector<std::string_view> unless{};  // keys of the table of which any makes a required one needless
  bool list = false;                       // any number of values, not one for each coordinate
  bool of_stress = false;  // one value for each component of a stress: xx; xx, yy, zz, xy; in space yz, zx besides
  bool of_turn = false;    // one value for each turn of a rigid body: in the plane one, in space three
  bool on_face = false;    // one value for each axis but that of a face's normal
  bool in_plane = false;   // positions of two coordinates
  std::string_view row{};  // of an array of rows, each of which is an array: how a scene writes one
  std::array<int, 2> row_lengths{};  // the least and the largest number of entries of a row
  bool may_be_empty = false;
  Dims dims = kAnyDim;
  std::string_view listed_by{};  // the command that lists the words, if they are many
  /// A hint about an unknown word, in place of the known ones; empty: none.
  std::function<std::string(const std::string& word)> hint{};
  // Set by key():
  std::string_view name{}, help{};
  Kind kind = Kind::text;
  Shape shape = Shape::one;

  bool is_in(int dim) const { return (dims & dims_of(dim)) != 0; }
  std::vector<std::string> words_in(int dim) const;
  /// The numbers that may be written in the place of words, in scenes of any dimension of these.
  Range numbers_in(Dims dims) const;
};

enum class Repeat { once, array, once_or_array, named };

/// A table of a scene, [stop], or a kind of them, [[support]].
struct TableInfo {
  std::string_view path, help;  // path: empty for the top of the file
  Repeat repeat = Repeat::once;
  std::string_view needed_for{};  // why a scene has to have it; empty: it may be left out
  /// Its keys are those that there are if the key `choice_key`, such as a material's law, has the value `choice`.
  std::string_view choice_key{}, choice{};
  std::vector<KeyInfo> keys{};
  std::vector<std::string> tables{};  // the names of the tables below it
  Dims dims = kAnyDim;                // of the scenes that may have it
  /// Reads all that the file says in such tables.
  std::function<void(const TableInfo& self, const toml::table& root, Scene& scene, Reading& reading)> read{};

  bool is_in(int dim) const { return (dims & dims_of(dim)) != 0; }
  /// As a scene writes it: "[stop]", "[[support]]".
  std::string heading() const;
};

/// All tables in the order in which they are read; the catalogue must outlive them.
std::vector<TableInfo> scene_tables(const Catalogue& catalogue);

/// Reads every table of a scene. Constants are resolved on the way. False if the scene's dimension is not supported, so
/// that reading on would only produce nonsense.
bool read_tables(const std::vector<TableInfo>& tables, const toml::table& root, Scene& scene, Reading& reading);

/// The range of a number of cells: a larger one is a slip, not a grid.
inline constexpr Range kCells = from(1, 1e7);

/// In the order of DampingTreatment.
inline constexpr std::array<std::string_view, 5> kTreatments{"automatic", "averaged", "lagged", "implicit", "exact"};
/// [damping] and [integrator], which have no part in a static solution.
inline constexpr std::array<std::string_view, 2> kTablesOfMotion{"damping", "integrator"};

}  // namespace stillpoint
