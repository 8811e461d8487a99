#include "output/report/report_page.hpp"

#include <string_view>

namespace stillpoint {

extern const std::string_view report_page_template;  // made by src/cmake/report_page.cmake

namespace {

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char letter : text) {
    switch (letter) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      default:
        safe += letter;
    }
  }
  return safe;
}

// A script must not contain a "<" that begins "</script" or "<!--"; in JSON a "<" occurs in texts alone.
std::string text_in_script(const Json& data) {
  const std::string text = data.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char letter : text) {
    if (letter == '<') {
      safe += "\\u003c";
    } else {
      safe += letter;
    }
  }
  return safe;
}

}  // namespace

std::string report_page(const std::string& title, const Json& data) {
  constexpr std::string_view title_mark = "{{title}}", data_mark = "{{data}}";
  const std::string_view page = report_page_template;
  const std::size_t title_at = page.find(title_mark), title_end = title_at + title_mark.size();
  const std::size_t data_at = page.find(data_mark, title_end), data_end = data_at + data_mark.size();
  std::string text(page.substr(0, title_at));
  text += escaped(title);
  text += page.substr(title_end, data_at - title_end);
  text += text_in_script(data);
  text += page.substr(data_end);
  return text;
}

}  // namespace stillpoint
