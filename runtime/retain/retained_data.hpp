// SPDX-License-Identifier: Apache-2.0
// Data that survive a power cut: the interface through which the keeper reads and restores them.
#pragma once

#include <string>
#include <vector>

namespace nc::rt {

class RetainedData {
 public:
  virtual ~RetainedData() = default;
  virtual const char* name() const = 0;  // "devices of the ladder"
  virtual const char* start() const = 0; // the values that they have without a file, as part of a sentence: "are 0"

  // Whether a machine must not start as if nothing had happened when they are lost: then it is an alarm, and else only a sentence.
  virtual bool is_vital() const { return true; }

  // ---- before the first scan and after the last one ----
  // False when the bytes make no sense; nothing has changed then.
  virtual bool restore(const std::string& bytes) = 0;
  // Why restore() has refused the bytes, as the rest of a sentence behind the name of their file.
  virtual std::string why_refused(const std::string&) const { return " makes no sense"; }
  // Sentences about what restore() had to leave out.
  virtual std::vector<std::string> remarks() const { return {}; }
  virtual std::string now() = 0;

  // ---- in between, from one thread: want() asks for a copy, and take() fetches it and is false until it is there ----
  virtual void want() = 0;
  virtual bool take(std::string* bytes) = 0;

 protected:
  // Of why_refused().
  static constexpr char kOtherVersion[] = " is of another version of the control";
};

}  // namespace nc::rt
