#include <stillpoint/state_archive.hpp>

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace stillpoint {

void StateArchive::operator()(std::string_view name, Vec values) const {
  if (!restores()) return put(name, std::vector<double>(values.begin(), values.end()));
  const auto& stored = get<std::vector<double>>(name);
  expect_size(name, stored.size(), values.size());
  std::ranges::copy(stored, values.begin());
}

void StateArchive::all(std::string_view name, std::string& text) const {
  if (!restores()) return put(name, text);
  text = get<std::string>(name);
}

bool StateArchive::has_part(std::string_view name) const {
  const std::string prefix = path(name) + "/";
  const auto first = from_->lower_bound(prefix);
  return first != from_->end() && first->first.starts_with(prefix);
}

void StateArchive::everything(SavedState& values) const {
  if (!restores()) {
    for (const auto& [name, value] : values) put(name, value);
    return;
  }
  values.clear();
  for (auto one = from_->lower_bound(prefix_); one != from_->end() && one->first.starts_with(prefix_); ++one)
    values[one->first.substr(prefix_.size())] = one->second;
}

// As one text, and the length of each.
void StateArchive::all(std::string_view name, std::vector<std::string>& texts) const {
  const std::string lengths_name = std::string(name) + "_lengths";
  std::string joined;
  std::vector<std::size_t> lengths;
  for (const std::string& text : texts) {
    joined += text;
    lengths.push_back(text.size());
  }
  (*this)(name, joined);
  (*this)(lengths_name, lengths);
  if (!restores()) return;
  texts.clear();
  std::size_t from = 0;
  for (const std::size_t length : lengths) {
    if (length > joined.size() - from) break;
    texts.push_back(joined.substr(from, length));
    from += length;
  }
  if (texts.size() != lengths.size() || from != joined.size())
    throw StateError(fmt::format("'{}' is not as long as its parts", path(name)));
}

void StateArchive::put(std::string_view name, SavedValue value) const {
  const auto [place, is_new] = to_->insert_or_assign(path(name), std::move(value));
  if (!is_new) throw std::logic_error(fmt::format("two values of a state are called '{}'", place->first));
}

template <class Stored>
const Stored& StateArchive::get(std::string_view name) const {
  const auto found = from_->find(path(name));
  if (found == from_->end()) throw StateError(fmt::format("it has no '{}'", path(name)));
  const auto* stored = std::get_if<Stored>(&found->second);
  if (!stored) throw StateError(fmt::format("'{}' is of another kind", path(name)));
  return *stored;
}
template const std::vector<double>& StateArchive::get(std::string_view) const;
template const std::vector<std::int64_t>& StateArchive::get(std::string_view) const;
template const std::string& StateArchive::get(std::string_view) const;

void StateArchive::expect_size(std::string_view name, std::size_t found, std::size_t expected) const {
  if (found != expected) throw StateError(fmt::format("'{}' has {} values, expected {}", path(name), found, expected));
}

}  // namespace stillpoint
