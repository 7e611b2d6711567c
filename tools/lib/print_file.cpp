// SPDX-License-Identifier: Apache-2.0
#include "tools/lib/print_file.hpp"

#include <cerrno>
#include <system_error>

namespace nc::tools {

bool PrintFile::open(const std::string& path, std::string* error) {
  file_.reset(std::fopen(path.c_str(), "ae"));
  if (file_) return true;
  *error = path + ": " + std::generic_category().message(errno);
  return false;
}

void PrintFile::write(const nc_text& text) {
  if (!file_) return;
  std::string line(text.s, text.size);
  for (const char* c = text.s; text.size == 0 && *c != 0; ++c)
    if (static_cast<unsigned char>(*c) >= 0x20) line += *c;
  line += '\n';
  if (std::fwrite(line.data(), 1, line.size(), file_.get()) == line.size() && std::fflush(file_.get()) == 0) return;
  if (error_.empty()) error_ = std::generic_category().message(errno);
}

}  // namespace nc::tools
