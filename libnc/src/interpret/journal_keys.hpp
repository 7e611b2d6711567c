// SPDX-License-Identifier: Apache-2.0
// First keys, in an interpreter's journal (macro/journal.hpp), of the places that are not variables: the table of frames, the records, the parameters.
#pragma once

#include "macro/variables.hpp"

namespace nc {

inline constexpr uint32_t kFrameKey = Variables::kForeignKey;
inline constexpr uint32_t kRecordKey = Variables::kForeignKey + 0x10000000;
inline constexpr uint32_t kParameterKey = Variables::kForeignKey + 0x20000000;

}  // namespace nc
