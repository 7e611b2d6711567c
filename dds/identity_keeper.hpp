// SPDX-License-Identifier: Apache-2.0
// Keeps a program with DDS Security going while its keys change. A participant of DDS has its certificate for as long as it lives, so new files need a new
// participant: what uses the participant (a gateway, the readers of a screen) is made a second time with them, stands by until those who talk with the first
// one talk with it, too, and then takes its place. With other permissions, or another governance, the old one is ended first, and those who talk with it find
// the new one as they would after a restart.
//
// Without new files what uses the old ones is ended before their certificate is, and comes back with the next files that are valid.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "dds/security.hpp"

namespace nc::dds {

// What has a participant with these keys.
class SecuredPart {
 public:
  virtual ~SecuredPart() = default;
  // Number of readers and writers of others that it talks with.
  virtual unsigned partners() const = 0;
};

// What differs between the programs that keep an identity.
struct IdentityUse {
  std::string folder;   // of the identity
  std::string without;  // what the program does without a valid one: "publishes nothing"
  // Makes the part with the files that are in the folder now. Null with a sentence in *error.
  std::function<std::unique_ptr<SecuredPart>(bool stands_by, std::string* error)> make;
  // From here on `to` is used in place of `from`; one of them may be null. `from` ends afterwards.
  std::function<void(SecuredPart* from, SecuredPart* to)> change;
  // Prints a sentence; `lasts`: it says what is so from now on, and not what has just happened.
  std::function<void(const std::string& text, bool lasts)> tell;
};

class IdentityKeeper {
 public:
  explicit IdentityKeeper(IdentityUse use) : use_(std::move(use)) {}
  IdentityKeeper(const IdentityKeeper&) = delete;
  IdentityKeeper& operator=(const IdentityKeeper&) = delete;
  // Makes the first part. False with a sentence in *error when the files cannot be used; with `waits`, an identity that has expired, or has not begun, is
  // waited for, and is no failure.
  bool open(bool waits, std::string* error);
  // Does what is due: looks at the files twice a second, changes over, ends in time. To be called at least every 100 ms; `now`: looks at the files at once.
  void look(bool now = false);
  // Null while there is no valid identity.
  SecuredPart* current() const { return current_.part.get(); }
  // Stands by; usually null.
  SecuredPart* next() const { return next_.part.get(); }
  void end();

 private:
  struct Running {
    Identity identity;
    std::unique_ptr<SecuredPart> part;
  };
  void look_at_files(std::int64_t now_s);
  void use(const Identity& identity);
  bool begin(const Identity& identity, bool stands_by, Running* running, std::string* error);
  void change_over(std::int64_t now_s);
  void end_current();
  void end_in_time(std::int64_t now_s);
  void warn_in_time(std::int64_t now_s);
  void fault(const std::string& text);
  void say(const std::string& text);

  const IdentityUse use_;
  Running current_, next_;
  std::string stamp_;             // of the files that were looked at last
  std::int64_t next_look_ns_ = 0;
  std::int64_t retry_s_ = 0;      // they are looked at again at this time, although they have not changed; 0 = never
  std::int64_t next_since_ns_ = 0, settled_since_ns_ = 0;
  std::int64_t warn_s_ = 0;       // time of the next warning
  std::string said_;
};

}  // namespace nc::dds
