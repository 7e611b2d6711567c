// SPDX-License-Identifier: Apache-2.0
// Data that survive a power cut: what the keeper asks of them.
#pragma once

#include <string>

namespace nc::rt {

class RetainedData {
 public:
  virtual ~RetainedData() = default;
  virtual const char* name() const = 0;  // "devices of the ladder"
  virtual const char* start() const = 0; // what they begin with without a file: "are 0"

  // ---- before the first scan and behind the last ----
  // False when the bytes make no sense; nothing has changed then.
  virtual bool restore(const std::string& bytes) = 0;
  virtual std::string now() = 0;

  // ---- in between, from one thread: a copy is asked for, and taken when it is there ----
  virtual void want() = 0;
  virtual bool take(std::string* bytes) = 0;
};

}  // namespace nc::rt
