#include "lib/failure/printable.hpp"

#include <algorithm>
#include <cstdint>

namespace yars::failure {

namespace {

// Bytes of the character that this one begins; 0: none begins so.
std::size_t length_of(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return 2;
  if (first >= 0xE0 && first <= 0xEF) return 3;
  if (first >= 0xF0 && first <= 0xF4) return 4;
  return 0;
}

bool continues(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

// The code point of the whole character at the front of `text`; a control character where there is none.
std::uint32_t code_point(std::string_view text, std::size_t length) {
  const auto first = static_cast<unsigned char>(text[0]);
  if (length == 1) return first;
  std::uint32_t code = first & (0xFFU >> (length + 1));
  for (const char byte : text.substr(1, length - 1)) code = code << 6U | (static_cast<unsigned char>(byte) & 0x3FU);
  const bool overlong = (length == 3 && code < 0x800U) || (length == 4 && code < 0x10000U);
  const bool surrogate = code >= 0xD800U && code <= 0xDFFFU;
  return overlong || surrogate || code > 0x10FFFFU ? 0U : code;
}

bool is_control(std::uint32_t code) {
  return code < 0x20U || (code >= 0x7FU && code < 0xA0U) || (code >= 0x2028U && code <= 0x202EU) ||
         (code >= 0x2066U && code <= 0x2069U) || code == 0x200EU || code == 0x200FU;
}

void append_escaped(std::string& shown, char byte) {
  constexpr std::string_view kHex = "0123456789abcdef";
  const auto value = static_cast<unsigned char>(byte);
  if (byte == '\n') {
    shown += "\\n";
  } else if (byte == '\t') {
    shown += "\\t";
  } else {
    shown += {'\\', 'x', kHex[value >> 4U], kHex[value & 0xFU]};
  }
}

std::string escaped(std::string_view text, bool keep_lines) {
  std::string shown;
  shown.reserve(text.size());
  while (!text.empty()) {
    std::size_t length = length_of(static_cast<unsigned char>(text[0]));
    const bool whole = length > 0 && length <= text.size() &&
                       std::all_of(text.begin() + 1, text.begin() + static_cast<std::ptrdiff_t>(length), continues);
    if (!whole) length = 1;
    const bool kept =
        whole && (!is_control(code_point(text, length)) || (keep_lines && (text[0] == '\n' || text[0] == '\t')));
    if (kept) shown += text.substr(0, length);
    if (!kept) std::for_each_n(text.begin(), length, [&](char byte) { append_escaped(shown, byte); });
    text.remove_prefix(length);
  }
  return shown;
}

}  // namespace

std::string printable(std::string_view text) {
  return escaped(text, false);
}

std::string printable_lines(std::string_view text) {
  return escaped(text, true);
}

std::size_t unfinished_bytes(std::string_view text) {
  for (std::size_t back = 1; back <= std::min<std::size_t>(3, text.size()); ++back) {
    const char byte = text[text.size() - back];
    if (continues(byte)) continue;
    return length_of(static_cast<unsigned char>(byte)) > back ? back : 0;
  }
  return 0;
}

}  // namespace yars::failure
