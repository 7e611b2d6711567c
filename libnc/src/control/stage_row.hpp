// SPDX-License-Identifier: Apache-2.0
// The row of stages between the interpreter and commit. Items go in at the front, stage by stage, and come out behind the last one in the
// order in which they went in. What a stage is:
//
//   using Rule                      the parameters that the stage needs; rule_of(stage, settings) picks them out of those that travel with a move
//   bool takes(item, rule, calm)    asked while the stage is at rest: whether this item makes it begin to hold items back. `calm`: the stages
//                                   behind it are at rest, too
//   bool push(item, rule)           gives it an item. False: the items that it holds have to go first, so pop() until there is none
//   bool pop(item&)                 the next finished item; false when it has none or must see more items first
//   bool idle()                     at rest: it holds nothing, and nothing that it has seen changes the items to come. Items bypass it
//   Resume resume_point()           what it needs to go on right behind the mark that pop() gave last; in_force(Resume): it needs anything at all
//   void restore(Resume)            goes on right behind that mark
//   void reset()                    forgets everything
//   kHeld                           the number of items that it has room for
//   void displaced()                tells it, while it holds nothing, that the axes have been moved by hand behind the newest mark that was executed
//
// Several stages may hold items at the same time. When a mark leaves a stage, what this stage needs to go on behind the mark is written down
// under the number of the mark (Mark::place) and goes out with it. So a mark that can be rewound to covers every stage, however far the stages
// in front have gone on meanwhile.
#pragma once

#include <bit>
#include <tuple>
#include <type_traits>
#include <utility>

#include "base/arena.hpp"
#include "frame/affine.hpp"
#include "interpret/motion_settings.hpp"
#include "stream/stream.hpp"

namespace nc {

/// What the stages of a row need to go on right behind a mark.
template <class... Stages>
struct StageResume {
  uint8_t stages = 0;  ///< bit k: stage k needs anything
  std::tuple<typename Stages::Resume...> of;
  /// Copies `other`, except for the stages that need nothing.
  void take(const StageResume& other) { take(other, std::index_sequence_for<Stages...>{}); }

 private:
  template <size_t... K>
  void take(const StageResume& other, std::index_sequence<K...>) {
    stages = other.stages;
    ((((stages >> K) & 1) != 0 ? static_cast<void>(std::get<K>(of) = std::get<K>(other.of)) : void()), ...);
  }
};

template <class... Stages>
class StageRow {
 public:
  using Resume = StageResume<Stages...>;
  /// What has become of an item that was pushed. taken: a stage holds it. straight: no stage has to hold it back. later: push it again after the
  /// held items have been popped.
  enum class Intake : uint8_t { taken, straight, later };

  void create(const InternPool<MotionSettings>* settings, Arena& arena) {
    settings_ = settings;
    places_ = arena.make<Resume>(kPlaces);
  }
  template <class Stage>
  Stage& stage() {
    return std::get<Stage>(stages_);
  }

  /// Every stage is at rest: an item that none of them takes goes straight through.
  bool idle() const { return busy_ == 0; }
  /// Pushes an item into the row. A mark that a stage may take gets its number (Mark::place) first.
  Intake push(Item& item) {
    if (item.kind == ItemKind::mark && item.mark.resume && item.mark.place == 0 && busy_ != 0) give_place(item);
    return push_from<0>(item);
  }
  /// The next item behind the last stage; false when there is none, or a stage must see more items first.
  bool pop(Item& out) { return pop_behind<sizeof...(Stages) - 1>(out); }
  /// What the stages need to go on right behind this mark, which pop() has given.
  const Resume& behind(const Mark& mark) const { return mark.place == 0 ? kNothing : places_[mark.place % kPlaces]; }

  /// Resets all stages, and lets those whose bit is set in `which` go on from `resume`.
  void restore(const Resume& resume, uint8_t which) {
    reset();
    restore(resume, which, kAll);
  }
  /// A stage that holds nothing goes on from `resume`.
  template <class Stage>
  void go_on_from(const typename Stage::Resume& resume) {
    std::get<Stage>(stages_).restore(resume);
    look(kAll);
  }
  /// The number of a stage in the row.
  template <class Stage>
  static constexpr size_t place_of() {
    constexpr bool kIs[] = {std::is_same_v<Stage, Stages>...};
    size_t place = 0;
    while (!kIs[place]) ++place;
    return place;
  }
  void reset() {
    std::apply([](auto&... stage) { (stage.reset(), ...); }, stages_);
    for (auto& door : door_) door.waits = false;
    busy_ = 0;
  }
  /// Tells the stages that the axes have been moved by hand. Returns the bits of the stages that are at rest by that: they need nothing any more.
  uint8_t displaced() {
    const uint8_t before = busy_;
    std::apply([](auto&... stage) { (stage.displaced(), ...); }, stages_);
    look(kAll);
    return static_cast<uint8_t>(before & ~busy_);
  }

 private:
  static constexpr auto kAll = std::index_sequence_for<Stages...>{};
  /// The most marks that can be under way: as many as the stages hold items, one at each door, and one on its way to the sink.
  static constexpr unsigned kPlaces = std::bit_ceil((Stages::kHeld + ... + (unsigned{sizeof...(Stages)} + 1)));
  static inline constexpr Resume kNothing{};

  /// The door of a stage: an item that has left the stage before, and waits because this stage cannot take it yet.
  struct Door {
    Item item;
    bool waits = false;
  };

  template <size_t K>
  bool busy() const {
    return (busy_ >> K & 1) != 0;
  }
  template <size_t K>
  void look() {
    const bool busy = !std::get<K>(stages_).idle() || door_[K].waits;
    busy_ = static_cast<uint8_t>(busy ? busy_ | 1u << K : busy_ & ~(1u << K));
  }
  template <size_t... K>
  void look(std::index_sequence<K...>) {
    (look<K>(), ...);
  }
  template <size_t... K>
  void restore(const Resume& resume, unsigned which, std::index_sequence<K...>) {
    ((((which >> K) & 1) != 0 ? std::get<K>(stages_).restore(std::get<K>(resume.of)) : void()), ...);
    look(kAll);
  }

  void give_place(Item& item) {
    if (++last_place_ == 0) ++last_place_;
    item.mark.place = last_place_;
    places_[last_place_ % kPlaces].stages = 0;
  }

  const MotionSettings& settings_of(const Item& item) const { return (*settings_)[item.kind == ItemKind::move ? item.move.settings : 0]; }
  template <size_t K>
  bool enters(const Item& item) const {
    if (busy<K>()) return true;
    const auto& stage = std::get<K>(stages_);
    return item.kind == ItemKind::move && stage.takes(item, rule_of(stage, settings_of(item)), busy_ >> K == 0);
  }
  template <size_t K>
  bool put(const Item& item) {
    auto& stage = std::get<K>(stages_);
    const bool in = stage.push(item, rule_of(stage, settings_of(item)));
    look<K>();
    return in;
  }

  template <size_t K>
  Intake push_from(const Item& item) {
    if constexpr (K == sizeof...(Stages)) {
      return Intake::straight;
    } else {
      if (!enters<K>(item)) return push_from<K + 1>(item);
      return put<K>(item) ? Intake::taken : Intake::later;
    }
  }

  /// The next item behind stage K.
  template <size_t K>
  bool pop_behind(Item& out) {
    auto& stage = std::get<K>(stages_);
    for (;;) {
      if (busy<K>()) {
        const bool any = stage.pop(out);
        if (any) note<K>(out);
        look<K>();
        if (any) return true;
      }
      if constexpr (K == 0) {
        return false;
      } else {
        Door& door = door_[K];
        if (door.waits) {
          door.waits = !put<K>(door.item);
          look<K>();
          continue;
        }
        if (!pop_behind<K - 1>(out)) return false;
        if (!enters<K>(out)) return true;
        if (put<K>(out)) continue;
        door.item = out;
        door.waits = true;
        look<K>();
      }
    }
  }

  template <size_t K>
  void note(const Item& item) {
    if (item.kind != ItemKind::mark || item.mark.place == 0) return;
    const auto& resume = std::get<K>(stages_).resume_point();
    if (!in_force(resume)) return;
    Resume& place = places_[item.mark.place % kPlaces];
    std::get<K>(place.of) = resume;
    place.stages = static_cast<uint8_t>(place.stages | 1u << K);
  }

  std::tuple<Stages...> stages_;
  Door door_[sizeof...(Stages)];
  uint8_t busy_ = 0;  ///< bit k: stage k is not at rest
  uint32_t last_place_ = 0;
  Resume* places_ = nullptr;
  const InternPool<MotionSettings>* settings_ = nullptr;
};

}  // namespace nc
