// SPDX-License-Identifier: Apache-2.0
// What the configuration and exported tables call a set of work offsets: EXT is 0 of nc_work_offset_set(), G54 to G59 are 1 to 6, G54.1P<n> is 100 + n.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace nc::rt {

inline constexpr unsigned kPlainWorkOffsets = 6, kExtendedWorkOffset = 100;

// `sets`: number of extended sets. Nothing when there is no set of that name.
std::optional<unsigned> work_offset_index(std::string_view name, unsigned sets);
std::string work_offset_name(unsigned index);

// The number from min to max that the whole text is; nothing when it is none.
std::optional<unsigned> whole_number(std::string_view text, unsigned min, unsigned max);

}  // namespace nc::rt
