// SPDX-License-Identifier: Apache-2.0
// The manual names one message; its code here is the message without the blank. All other conditions have the codes of dialect/default_alarms.cpp.
#include "dialect/series8/tables.hpp"

namespace nc::series8 {

using C = Condition;

const AlarmText kAlarms[] = {
    {"INVALIDARC", "INVALID ARC"},
};

const AlarmRow kConditions[] = {
    {C::arc_center, "INVALIDARC", nullptr},  // G02
    {C::center_missing, "INVALIDARC", nullptr},
    {C::arc_deviation, "INVALIDARC", nullptr},
    {C::arc_by_hand, "INVALIDARC", nullptr},
};

}  // namespace nc::series8
