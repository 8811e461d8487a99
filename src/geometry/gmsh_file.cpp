// [Geuzaine and Remacle 2009; the Gmsh reference manual, MSH file format].
#include "geometry/gmsh_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text.hpp"

namespace stillpoint {
namespace {

struct Kind {
  int number, dim;
  std::size_t nodes;
};
/// Those whose borders are known, and those of fewer dimensions, which are passed over.
constexpr std::array<Kind, 17> kKinds{{{15, 0, 1},
                                       {1, 1, 2},
                                       {8, 1, 3},
                                       {26, 1, 4},
                                       {2, 2, 3},
                                       {3, 2, 4},
                                       {9, 2, 6},
                                       {10, 2, 9},
                                       {16, 2, 8},
                                       {20, 2, 9},
                                       {21, 2, 10},
                                       {4, 3, 4},
                                       {5, 3, 8},
                                       {6, 3, 6},
                                       {7, 3, 5},
                                       {11, 3, 10},
                                       {27, 1, 5}}};

/// What is wrong, at a byte of the file.
struct Fault {
  std::size_t at;
  std::string why;
};

/// The words of a file, one after the other.
class Words {
 public:
  explicit Words(std::string text) : text_(std::move(text)) {}

  /// Empty at the end of the file.
  std::string_view next() {
    constexpr std::string_view spaces = " \t\r\n";
    word_at_ = std::min(text_.find_first_not_of(spaces, at_), text_.size());
    at_ = std::min(text_.find_first_of(spaces, word_at_), text_.size());
    return std::string_view(text_).substr(word_at_, at_ - word_at_);
  }
  template <class Number>
  Number number(const char* what) {
    const std::string_view word = next();
    Number value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    bool is_number = error == std::errc() && end == word.data() + word.size();
    if constexpr (std::is_floating_point_v<Number>) is_number = is_number && std::isfinite(value);
    if (!is_number) refuse(fmt::format("expected {}, found '{}'", what, word));
    return value;
  }
  /// A name in quotes.
  std::string name() {
    const std::size_t from = text_.find('"', at_), to = text_.find('"', std::min(from, text_.size() - 1) + 1);
    if (to == std::string::npos || text_.find('\n', at_) == std::string::npos) refuse("expected a name in quotes");
    at_ = to + 1;
    return text_.substr(from + 1, to - from - 1);
  }
  void skip(std::size_t count) {
    for (std::size_t k = 0; k < count; ++k)
      if (next().empty()) refuse("the file ends too early");
  }
  void skip_line() { at_ = std::min(text_.find('\n', at_), text_.size()); }
  void skip_section(std::string_view begin) {
    const std::string end = fmt::format("$End{}", begin.substr(1));
    while (next() != end)
      if (at_ == text_.size()) refuse(fmt::format("expected {}", end));
  }
  [[noreturn]] void refuse(std::string why) const { throw Fault{word_at_, std::move(why)}; }
  Location location(std::size_t at, const std::filesystem::path& file) const {
    const std::size_t begin = at == 0 ? 0 : text_.rfind('\n', at - 1) + 1;  // npos + 1 = 0
    const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(begin), '\n');
    return {file.string(), static_cast<int>(line), static_cast<int>(at - begin) + 1};
  }

 private:
  std::string text_;
  std::size_t at_ = 0, word_at_ = 0;
};

class GmshReader {
 public:
  GmshReader(Words& words, int dim, const std::string& group) : words_(words), dim_(dim), group_(group) {}

  Mesh read() {
    read_format();
    for (std::string_view section = words_.next(); !section.empty(); section = words_.next()) {
      const std::string name(section);
      if (name == "$PhysicalNames") {
        read_names();
      } else if (name == "$Entities" && is_of_blocks_) {
        read_entities();
      } else if (name == "$Nodes") {
        is_of_blocks_ ? read_blocks_of_nodes() : read_nodes();
      } else if (name == "$Elements") {
        is_of_blocks_ ? read_blocks_of_elements() : read_elements();
      } else if (!name.starts_with('$')) {
        words_.refuse(fmt::format("expected a section, such as $Nodes, found '{}'", name));
      }
      words_.skip_section(name);
    }
    return std::move(mesh_);
  }
  /// The groups of these dimensions.
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& [group, name] : names_)
      if (group.first == dim_) names.push_back(in_quotes(name));
    return names;
  }

 private:
  using Group = std::pair<int, int>;  // its dimensions and its tag

  void read_format() {
    if (words_.next() != "$MeshFormat") words_.refuse("is no mesh of Gmsh's, which begins with $MeshFormat");
    const std::string version(words_.next());
    if (version != "4.1" && version != "2.2")
      words_.refuse(
          fmt::format("is a mesh of format {}; expected 4.1 or 2.2, which gmsh -format msh41 writes", version));
    is_of_blocks_ = version == "4.1";
    if (words_.number<int>("0 for text or 1 for a binary file") != 0)
      words_.refuse("is a binary mesh; expected text, which Gmsh writes with Mesh.Binary = 0");
    words_.skip_section("$MeshFormat");
  }

  void read_names() {
    for (auto count = words_.number<long>("the number of names"); count > 0; --count) {
      const int dim = words_.number<int>("the dimension of a group"), tag = words_.number<int>("the tag of a group");
      names_[{dim, tag}] = words_.name();
    }
  }

  bool is_asked(int tag) const {
    if (group_.empty()) return true;
    const auto found = names_.find({dim_, tag});
    return found != names_.end() ? found->second == group_ : fmt::format("{}", tag) == group_;
  }

  // --- 4.1: elements in blocks, each of an entity, which is in physical groups ---

  void read_entities() {
    std::array<long, 4> counts{};
    for (long& count : counts) count = words_.number<long>("the number of entities");
    for (int dim = 0; dim < 4; ++dim) {
      for (long k = 0; k < counts[static_cast<std::size_t>(dim)]; ++k) {
        const int tag = words_.number<int>("the tag of an entity");
        words_.skip(dim == 0 ? 3 : 6);
        for (auto groups = words_.number<long>("the number of groups"); groups > 0; --groups) {
          const int group = std::abs(words_.number<int>("the tag of a group"));
          if (dim == dim_ && is_asked(group)) asked_.insert(tag);
        }
        words_.skip_line();
      }
    }
  }

  void read_blocks_of_nodes() {
    auto blocks = words_.number<long>("the number of blocks");
    for (words_.skip(3); blocks > 0; --blocks) {
      const auto dim = words_.number<std::size_t>("the dimension of an entity");
      words_.skip(1);
      const std::size_t further = words_.number<int>("0 or 1 for parameters") != 0 ? dim : 0;
      std::vector<std::size_t> tags;
      for (auto count = words_.number<long>("the number of nodes"); count > 0; --count)
        tags.push_back(words_.number<std::size_t>("the tag of a node"));
      for (const std::size_t tag : tags) {
        read_node(tag);
        words_.skip(further);
      }
    }
  }

  void read_blocks_of_elements() {
    auto blocks = words_.number<long>("the number of blocks");
    for (words_.skip(3); blocks > 0; --blocks) {
      const int dim = words_.number<int>("the dimension of an entity"), entity = words_.number<int>("its tag");
      const Kind* const kind = kind_of(words_.number<int>("the kind of an element"), dim);
      const bool is_in = dim == dim_ && (group_.empty() || asked_.contains(entity));
      for (auto count = words_.number<long>("the number of elements"); count > 0; --count) {
        words_.skip(1);
        kind ? read_element(*kind, is_in) : words_.skip_line();
      }
    }
  }

  // --- 2.2: elements line by line, the first of their tags that of a physical group ---

  void read_nodes() {
    for (auto count = words_.number<long>("the number of nodes"); count > 0; --count)
      read_node(words_.number<std::size_t>("the tag of a node"));
  }

  void read_elements() {
    for (auto count = words_.number<long>("the number of elements"); count > 0; --count) {
      words_.skip(1);
      const Kind* const kind = kind_of(words_.number<int>("the kind of an element"), -1);
      const auto tags = words_.number<std::uint32_t>("the number of tags");
      const int group = tags > 0 ? words_.number<int>("the tag of a group") : 0;
      if (tags > 1) words_.skip(tags - 1);
      kind ? read_element(*kind, kind->dim == dim_ && is_asked(group)) : words_.skip_line();
    }
  }

  // --- both ---

  /// Null: of other dimensions, and to be passed over.
  const Kind* kind_of(int number, int dim) const {
    const auto found = std::ranges::find(kKinds, number, &Kind::number);
    if (found != kKinds.end()) return &*found;
    if (dim >= 0 && dim != dim_) return nullptr;
    words_.refuse(
        fmt::format("has elements of Gmsh's kind {}; expected triangles and quadrilaterals of order 1 and 2, "
                    "tetrahedra of order 1 and 2, and hexahedra, prisms and pyramids of order 1",
                    number));
  }
  void read_node(std::size_t tag) {
    SpacePoint x;
    for (double& along : x) along = words_.number<double>("a coordinate");
    mesh_.nodes[tag] = x;
  }
  void read_element(const Kind& kind, bool is_in) {
    std::vector<std::size_t> nodes(kind.nodes);
    for (std::size_t& node : nodes) {
      node = words_.number<std::size_t>("the tag of a node");
      if (!mesh_.nodes.contains(node)) words_.refuse(fmt::format("there is no node {}", node));
    }
    if (is_in) mesh_.elements.push_back({kind.number, std::move(nodes)});
  }

  Words& words_;
  int dim_;
  const std::string& group_;
  bool is_of_blocks_ = true;
  std::map<Group, std::string> names_;
  std::set<int> asked_;  // the entities of the group
  Mesh mesh_;
};

}  // namespace

Mesh read_gmsh_file(const std::filesystem::path& file, int dim, const std::string& group,
                    std::vector<Mistake>& problems) {
  const auto refuse = [&](const std::string& why, Location where) {
    problems.push_back({std::move(where), why});
    return Mesh{};
  };
  const Location whole{file.string(), 0, 0};
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return refuse("there is no such file", whole);
  std::ifstream stream(file, std::ios::binary);
  if (!std::filesystem::is_regular_file(file, error) || !stream) return refuse("cannot be opened for reading", whole);
  Words words({std::istreambuf_iterator<char>(stream), {}});
  GmshReader reader(words, dim, group);
  try {
    Mesh mesh = reader.read();
    if (!mesh.elements.empty()) return mesh;
    const char* const elements = dim == 2 ? "surfaces" : "volumes";
    if (group.empty()) return refuse(fmt::format("holds no elements of {}", elements), whole);
    const std::vector<std::string> names = reader.names();
    return refuse(fmt::format("has no physical group {} of {}; it has {}", in_quotes(group), elements,
                              names.empty() ? "none with a name" : fmt::format("{}", fmt::join(names, ", "))),
                  whole);
  } catch (const Fault& fault) {
    return refuse(fault.why, words.location(fault.at, file));
  }
}

}  // namespace stillpoint
