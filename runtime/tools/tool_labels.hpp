// SPDX-License-Identifier: Apache-2.0
// The name of a tool and the pocket of the magazine in which it is. Neither means anything to a program, so they are the runtime's and not the control's: people read the
// names, and who loads the magazine sees where each tool belongs.
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

namespace nc::rt {

struct ToolLabel {
  std::string name;
  unsigned pocket = 0;  // 0 = in none
  bool operator==(const ToolLabel&) const = default;
};
// By the number of the tool offset set; a tool that has neither needs no entry.
using ToolLabels = std::map<unsigned, ToolLabel>;

inline constexpr std::size_t kLongestToolName = 64;  // bytes of UTF-8
inline constexpr unsigned kMostPocket = 9999;

// The label of a tool, empty when it has none.
const ToolLabel& label_of(const ToolLabels& labels, unsigned tool);
// "" = the text can be the name of a tool, else what is wrong with it: it would not stand in one line of a screen.
std::string tool_name_trouble(std::string_view name);
// Another tool that is in the pocket of this one; 0 = none.
unsigned other_in_pocket(const ToolLabels& labels, unsigned tool);
// "tool 3 (drill)"
std::string tool_text(const ToolLabels& labels, unsigned tool);

struct Config;
// Those of the configuration.
ToolLabels configured_labels(const Config& config);

// The labels of the machine. Any thread.
class ToolLabelTable {
 public:
  ToolLabels read() const {
    const std::lock_guard lock(mutex_);
    return labels_;
  }
  // A change is made in a copy, which then takes the place of all: nobody sees, and nothing is kept of, a half of one.
  void replace(ToolLabels labels) {
    const std::lock_guard lock(mutex_);
    labels_ = std::move(labels);
  }

 private:
  mutable std::mutex mutex_;
  ToolLabels labels_;
};

}  // namespace nc::rt
