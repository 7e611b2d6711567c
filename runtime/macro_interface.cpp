// SPDX-License-Identifier: Apache-2.0
// Macro interface image. M700 13.5.5:
//   in   #1000..#1031 = bits of #1032    #1200..#1231 = #1033    #1232..#1263 = #1034    #1264..#1295 = #1035
//   out  #1100..#1131 = bits of #1132    #1300..#1331 = #1133    #1332..#1363 = #1134    #1364..#1395 = #1135
#include "runtime/macro_interface.hpp"

#include <algorithm>

namespace nc::rt {
namespace {

constexpr std::uint8_t kWholeWord = 255;

}  // namespace

MacroInterface::MacroInterface(const MacroMap& map, const hal::PointImage& initial) {
  for (unsigned w = 0; w < NC_WORDS; ++w) {
    const auto word = static_cast<std::uint8_t>(w);
    if (map.input_word[w] >= 0)
      inputs_.push_back({word, kWholeWord, static_cast<std::uint16_t>(map.input_word[w])});
    if (map.output_word[w] >= 0)
      outputs_.push_back({word, kWholeWord, static_cast<std::uint16_t>(map.output_word[w])});
    for (unsigned b = 0; b < 32; ++b) {
      const auto bit = static_cast<std::uint8_t>(b);
      if (map.input_bit[w][b] >= 0)
        inputs_.push_back({word, bit, static_cast<std::uint16_t>(map.input_bit[w][b])});
      if (map.output_bit[w][b] >= 0)
        outputs_.push_back({word, bit, static_cast<std::uint16_t>(map.output_bit[w][b])});
    }
  }
  leave(initial);
  for (const Entry& entry : outputs_) take(entry);
}

void MacroInterface::gather(const hal::PointImage& points, std::uint32_t input[NC_WORDS]) const noexcept {
  for (unsigned w = 0; w < NC_WORDS; ++w) input[w] = 0;
  for (const Entry& entry : inputs_) {
    const std::uint32_t value = points.value[entry.point];
    input[entry.word] |= entry.bit == kWholeWord ? value : (value & 1u) << entry.bit;
  }
}

std::uint32_t MacroInterface::bits(const Entry& entry) noexcept {
  return entry.bit == kWholeWord ? ~0u : 1u << entry.bit;
}

void MacroInterface::mapped(std::uint32_t outputs[NC_WORDS]) const {
  std::fill_n(outputs, NC_WORDS, 0u);
  for (const Entry& entry : outputs_) outputs[entry.word] |= bits(entry);
}

void MacroInterface::take(const Entry& entry) noexcept {
  std::uint32_t& word = image_[entry.word];
  word = entry.bit == kWholeWord ? entry.left : (word & ~(1u << entry.bit)) | (entry.left & 1u) << entry.bit;
}

bool MacroInterface::take_over(const hal::PointImage& points, std::uint32_t found[NC_WORDS]) noexcept {
  std::fill_n(found, NC_WORDS, 0u);
  bool any = false;
  for (Entry& entry : outputs_) {
    if (points.value[entry.point] == entry.left) continue;
    entry.left = points.value[entry.point];
    take(entry);
    found[entry.word] |= bits(entry);
    any = true;
  }
  return any;
}

void MacroInterface::leave(const hal::PointImage& points) noexcept {
  for (Entry& entry : outputs_) entry.left = points.value[entry.point];
}

void MacroInterface::distribute(const std::uint32_t output[NC_WORDS], const std::uint32_t written[NC_WORDS],
                                hal::PointImage* points) noexcept {
  std::uint32_t any = 0;
  for (unsigned w = 0; w < NC_WORDS; ++w) {
    image_[w] = (image_[w] & ~written[w]) | (output[w] & written[w]);
    any |= written[w];
  }
  if (any == 0) return;
  for (const Entry& entry : outputs_) {
    if ((written[entry.word] & bits(entry)) == 0) continue;
    points->value[entry.point] = entry.bit == kWholeWord ? image_[entry.word] : image_[entry.word] >> entry.bit & 1u;
  }
}

}  // namespace nc::rt
