// SPDX-License-Identifier: Apache-2.0
// Names and pockets of tools that differ from the configuration, as text and back. They have a file of their own beside that of the offsets: a program that knows nothing of them
// neither reads nor replaces it. As with offsets, the configuration wins where it was changed since the file was written.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "runtime/retain/retained_data.hpp"
#include "runtime/tools/tool_labels.hpp"

namespace nc::rt {

std::string encode_tool_labels(const ToolLabels& now, const ToolLabels& configured);
// Puts the kept values over those of the configuration in *labels. False when the bytes are not such values; nothing has changed then. Tools above `most` are skipped. A
// kept tool whose pocket the configuration has given to another one is in none; each of them is a sentence in *remarks.
bool restore_tool_labels(const std::string& bytes, unsigned most, ToolLabels* labels, std::vector<std::string>* remarks);

class ToolLabelData final : public RetainedData {
 public:
  ToolLabelData(ToolLabelTable* table, unsigned most, ToolLabels configured) : table_(*table), most_(most), configured_(std::move(configured)) {}
  const char* name() const override { return "names and pockets of tools"; }
  const char* start() const override { return "are those of the configuration"; }
  bool restore(const std::string& bytes) override;
  std::string why_refused(const std::string& bytes) const override;
  std::vector<std::string> remarks() const override { return remarks_; }
  std::string now() override { return encode_tool_labels(table_.read(), configured_); }
  void want() override {}
  bool take(std::string* bytes) override {
    *bytes = now();
    return true;
  }

 private:
  ToolLabelTable& table_;
  const unsigned most_;
  const ToolLabels configured_;
  std::vector<std::string> remarks_;
};

}  // namespace nc::rt
