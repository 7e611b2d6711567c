/* SPDX-License-Identifier: Apache-2.0 */
/* 5. Offsets and variables kept over power off. A program measures (here: computes) and stores. The copy that is kept has what the
 * executed blocks have written, and nothing of the blocks that were only read ahead. A second control, built after "power on", gets it back. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "nc/nc.h"

enum { kMaxKept = 200, kOffsets = 7, kAxes = 3 };

/* What a host writes to its file or EEPROM. */
typedef struct kept {
  unsigned count;
  uint32_t number[kMaxKept];
  double value[kMaxKept];
  double work[kOffsets][kAxes]; /* external, G54 to G59 */
  double tool[10][4];           /* tools 1 to 10, the columns of nc_tool_column */
} kept;

/* An nc_look function: it may only read. */
static void take(void* user, const nc_control* nc) {
  kept* const to = user;
  memset(to, 0, sizeof *to);
  uint32_t number = 0;
  double value = 0;
  /* #500 and above outlive the power; #100 to #199 do not (M700 13.4). */
  for (uint32_t from = 500; to->count < kMaxKept && nc_variable_next(nc, 0, from, &number, &value) == NC_OK; from = number + 1) {
    to->number[to->count] = number;
    to->value[to->count++] = value;
  }
  for (unsigned index = 0; index < kOffsets; ++index)
    for (unsigned axis = 0; axis < kAxes; ++axis) nc_work_offset_get(nc, 0, index, axis, &to->work[index][axis]);
  for (unsigned tool = 1; tool <= 10; ++tool)
    for (unsigned column = 0; column < 4; ++column) nc_tool_offset_get(nc, tool, (nc_tool_column)column, &to->tool[tool - 1][column]);
}

static bool give_back(nc_control* nc, const kept* from) {
  bool good = true;
  for (unsigned i = 0; i < from->count; ++i) good = nc_variable_set(nc, 0, from->number[i], from->value[i], false) == NC_OK && good;
  for (unsigned index = 0; index < kOffsets; ++index)
    for (unsigned axis = 0; axis < kAxes; ++axis) good = nc_work_offset_set(nc, 0, index, axis, from->work[index][axis]) == NC_OK && good;
  for (unsigned tool = 1; tool <= 10; ++tool)
    for (unsigned column = 0; column < 4; ++column)
      good = nc_tool_offset_set(nc, tool, (nc_tool_column)column, from->tool[tool - 1][column]) == NC_OK && good;
  return good;
}

static nc_control* power_on(void** memory) {
  nc_config config;
  nc_config_init(&config);
  const size_t size = nc_memory_required(&config);
  *memory = aligned_alloc(64, (size + 63) / 64 * 64);
  return *memory != NULL ? nc_create(&config, *memory, size, NULL) : NULL;
}

/* Runs a program online until `until_x` is passed or it has ended. */
static bool run(nc_control* nc, const char* text, double until_x) {
  unsigned file = 0;
  if (nc_program_add_text(nc, "PART", text, strlen(text), &file) != NC_OK || nc_program_select(nc, 0, file) != NC_OK) return false;
  nc_inputs in;
  nc_outputs out;
  nc_inputs_init(&in);
  nc_outputs_init(&out);
  for (int cycle = 0; cycle < 10000; ++cycle) {
    nc_feed(nc, 100);
    nc_cycle(nc, &in, &out);
    in.cycle_start = true;
    if (out.command.v[0] > until_x || (out.state == NC_STATE_IDLE && out.blocks > 0)) return true;
  }
  return false;
}

int main(void) {
  void *first = NULL, *second = NULL;
  nc_control* nc = power_on(&first);
  /* The power fails in the second G01: the blocks behind it have been read but not executed. */
  bool good = nc != NULL && run(nc,
                                "#501=12.5\n"
                                "G10 L2 P1 X100. Y50.\n" /* G54 */
                                "G01 X1. F600\n"
                                "G01 X20.\n"
                                "#501=99\n"
                                "G10 L2 P1 X999.\n"
                                "M30\n",
                                5);
  static kept data;
  if (good) nc_look_executed(nc, take, &data);
  free(first); /* power off */

  nc = good ? power_on(&second) : NULL;
  good = nc != NULL && give_back(nc, &data);
  double value = 0, offset = 0;
  bool vacant = true;
  if (good) good = nc_variable_get(nc, 0, 501, &value, &vacant) == NC_OK && nc_work_offset_get(nc, 0, 1, 0, &offset) == NC_OK;
  printf("after power on: #501 = %g%s, G54 X = %g\n", value, vacant ? " (vacant)" : "", offset);
  free(second);
  return good ? 0 : 1;
}
