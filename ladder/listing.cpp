// SPDX-License-Identifier: Apache-2.0
// The program as a listing, with the power flow of a scan.
#include <algorithm>

#include "ladder/code.hpp"

namespace nc::ladder {
namespace {

// The words of a line as the compiler keeps it: with one blank between two of them.
void split(const std::string& text, ListedLine* line) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    if (at == 0) line->instruction = text.substr(0, end);
    else line->operands.push_back(text.substr(at, end - at));
    at = end + 1;
  }
}

}  // namespace

const std::string& Program::file() const { return code_->file; }
unsigned Program::line_count() const { return static_cast<unsigned>(code_->source.size()); }
std::size_t Program::flow_bytes() const { return code_->units.size(); }

std::vector<ListedLine> Program::listing(unsigned first, unsigned most, const std::uint8_t* flow, unsigned* next_rung) const {
  if (next_rung != nullptr) *next_rung = 0;
  const std::vector<std::uint32_t>& rungs = code_->rungs;
  auto rung = std::upper_bound(rungs.begin(), rungs.end(), first);  // the first one behind the line
  unsigned line = rung == rungs.begin() ? 1 : *(rung - 1);
  unsigned rung_line = line;
  std::vector<ListedLine> listed;
  for (; line <= line_count(); ++line) {
    if (rung != rungs.end() && line == *rung) {
      if (listed.size() >= most) {
        if (next_rung != nullptr) *next_rung = line;
        break;
      }
      rung_line = *rung;
      while (rung != rungs.end() && *rung == line) ++rung;
    }
    const std::string& text = code_->source[line - 1];
    if (text.empty()) continue;
    ListedLine& next = listed.emplace_back();
    next.line = line;
    next.rung = rung_line;
    split(text, &next);
  }
  if (flow == nullptr) return listed;
  for (const FlowPlace& place : code_->flow) {
    if ((flow[place.unit] & kFlowExecuted) == 0) continue;
    const auto at = std::lower_bound(listed.begin(), listed.end(), place.line, [](const ListedLine& l, std::uint32_t wanted) { return l.line < wanted; });
    if (at == listed.end() || at->line != place.line) continue;
    at->power = (flow[place.unit] & 1u) != 0 ? ListedLine::Power::kOn : ListedLine::Power::kOff;
  }
  return listed;
}

}  // namespace nc::ladder
