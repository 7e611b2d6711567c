// SPDX-License-Identifier: Apache-2.0
// The place in the programs when the power failed, as lines of text for the file in which it is kept, and as a sentence.
//
// It is written when the supply says that it fails (runtime/power/power_watch.hpp), and it is empty as soon as an operator has acknowledged it: behind the
// alarm when the power came back, or behind the next start of the control.
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "runtime/feeder.hpp"
#include "runtime/retain/program_place.hpp"
#include "runtime/retain/retained_data.hpp"

namespace nc::rt {

std::string encode_places(const std::vector<ProgramPlace>& places);
// False when the bytes are not such places; *places is empty then. No bytes are no places.
bool decode_places(const std::string& bytes, std::vector<ProgramPlace>* places);
// "part.nc, line 12, X1.5 Y-3". `systems`: there are several part systems, so each is named.
std::string place_text(const std::vector<ProgramPlace>& places, bool systems);

class PlaceData final : public RetainedData {
 public:
  PlaceData(Feeder* feeder, Scan* scan) : feeder_(*feeder), scan_(*scan) {}
  const char* name() const override { return "the places in the programs"; }
  const char* start() const override { return "are not known"; }
  bool restore(const std::string& bytes) override;
  std::string now() override { return kept_or(feeder_.place_bytes()); }
  void want() override { feeder_.want(Feeder::kPlace); }
  bool take(std::string* bytes) override;
  // The places that were found at the start. To be called behind restore(), which nothing else changes later.
  const std::vector<ProgramPlace>& found() const { return found_; }

 private:
  // What was found stays until it has been acknowledged, unless the power has failed once more.
  std::string kept_or(const std::string& now) const { return now.empty() && !found_.empty() && !scan_.place_seen() ? encode_places(found_) : now; }
  Feeder& feeder_;
  Scan& scan_;
  std::vector<ProgramPlace> found_;
};

// Where programs have stopped that did not come to their end: a restart begins there. They stay until the same program has come to its end.
class StopData final : public RetainedData {
 public:
  explicit StopData(Feeder* feeder) : feeder_(*feeder) {}
  const char* name() const override { return "the places where programs have stopped"; }
  const char* start() const override { return "are not known"; }
  bool restore(const std::string& bytes) override;
  std::string now() override { return feeder_.stop_bytes(); }
  void want() override { feeder_.want(Feeder::kStops); }
  bool take(std::string* bytes) override { return feeder_.take(Feeder::kStops, bytes); }

 private:
  Feeder& feeder_;
};

}  // namespace nc::rt
