// SPDX-License-Identifier: Apache-2.0
// nc_status_text.
#include "nc/types.h"

const char* nc_status_text(nc_status status) {
  switch (status) {
    case NC_OK:
      return "It is done.";
    case NC_WAITING:
      return "Nothing can be done until the machine has got further; call again.";
    case NC_BUDGET:
      return "The blocks that this call was allowed to read are used up; call again.";
    case NC_ENDED:
      return "The program has ended.";
    case NC_ALARMED:
      return "The program has stopped on an alarm; nc_alarm_get() tells which.";
    case NC_E_ARGUMENT:
      return "An argument is out of its range.";
    case NC_E_MEMORY:
      return "The memory given is too small, or a table of the control is full.";
    case NC_E_STATE:
      return "This cannot be done in the present state, for instance while a program runs.";
    case NC_E_NOT_FOUND:
      return "There is no such program, parameter, axis or variable.";
    case NC_E_READ:
      return "The text of a program cannot be read.";
  }
  return "This number is no status of the library.";
}
