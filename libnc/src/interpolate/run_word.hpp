// SPDX-License-Identifier: Apache-2.0
// Which run of a program scan and feeder are in. One word says it, the scan alone writes it, and the feeder answers with the word that it
// has acted upon: so that no two events between two turns of the feeder can look like another one, or like none.
//
//     word = epoch * 2 + active          epoch: how often everything that was committed has become void
//
//     state of the scan                      word     leaves it by                                        owner
//     IDLE                                   even     cycle start, once the feeder has taken this word    scan
//     RUNNING, HOLD, STOPPED                 odd      hold, block stop, cycle start: the word stays       scan
//                                                     end item: even, the same epoch, IDLE                scan
//                                                     reset, alarm or fault, at rest: even, next epoch    scan
//     ALARM of the program (alarm item)      odd      end item behind the alarm: even, the same epoch     scan
//     ALARM                                  even     reset: even, next epoch, IDLE                       scan
//
//     the feeder finds                       and does
//     odd, another word than the one taken   begins the selected program at its head, where the machine stands
//     even, the same epoch                   nothing: it has committed the end item
//     even, another epoch                    takes back what was read beyond the last block that was executed, unless that was the end;
//                                            interpreter as after reset
//
// The feeder looks in nc_feed(), and before every call that is refused while a program runs, so that none of them has to wait for nc_feed().
// A start waits until the feeder has taken the word that it changes: else the feeder could miss that something lay between two starts.
// A record carries the epoch that it was made in; the scan throws those of another one away.
//
// A reset comes to IDLE when (1) the axes have come to rest, (2) a truncation is withdrawn, or done by the feeder in the call that it is in
// (interpolate/truncation.hpp), (3) a rereading that was asked for is done, by the next nc_feed() whatever its state is.
//
// By the end of its 31 bits the epoch begins again at 0: it is only compared with records that are in the ring.
#pragma once

#include <cstdint>

namespace nc {

class RunWord {
 public:
  RunWord() = default;
  explicit RunWord(uint32_t word) : word_(word) {}
  uint32_t word() const { return word_; }
  uint32_t epoch() const { return word_ >> 1; }
  bool active() const { return (word_ & 1) != 0; }
  void start() { word_ |= 1u; }
  void end() { word_ &= ~1u; }
  void give_up() { word_ = (word_ | 1u) + 1u; }

 private:
  uint32_t word_ = 0;
};

}  // namespace nc
