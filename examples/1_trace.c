/* SPDX-License-Identifier: Apache-2.0 */
/* 1. Trace a program: what would it do? No machine, no time: the items are pulled one after the other. Where the program asks for
 * something that only a machine knows (here its position, #5021), the item is a sync and this program answers. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "nc/nc.h"

static const char program[] =
    "G21 G90 G17 G94\n"
    "G00 X10. Y0.\n"
    "G01 Y20. F600\n"
    "G02 X20. Y30. R10.\n"
    "#1=#5021\n" /* machine position of X */
    "G01 X[#1+5.]\n"
    "M30\n";

static const char* const kinds[] = {"rapid", "line", "arc", "helix", "skip", "thread", "tap", "spiral", "exponential", "nurbs", "spline"};

int main(void) {
  nc_config config;
  nc_config_init(&config);
  const size_t size = nc_memory_required(&config);
  void* memory = aligned_alloc(64, (size + 63) / 64 * 64);
  nc_status status = NC_E_MEMORY;
  nc_control* nc = memory != NULL ? nc_create(&config, memory, size, &status) : NULL;
  unsigned file = 0;
  if (nc != NULL) status = nc_program_add_text(nc, "PART", program, strlen(program), &file);
  if (status == NC_OK) status = nc_program_select(nc, 0, file);

  nc_item item = NC_INIT(nc_item);
  nc_world world = NC_INIT(nc_world);
  double length = 0;
  while (status == NC_OK) {
    status = nc_pull(nc, 0, 100, &item);
    if (status == NC_BUDGET) status = NC_OK; /* a hundred blocks without an item: go on reading */
    else if (status == NC_OK && item.kind == NC_ITEM_MOVE) {
      const nc_move* move = &item.u.move;
      printf("line %u: %-5s to X %.3f Y %.3f, %.3f mm\n", (unsigned)item.source.line, kinds[move->kind], move->work.v[0], move->work.v[1], move->length);
      length += move->length;
      world.machine = move->machine; /* a machine that goes where it is told */
    } else if (status == NC_OK && item.kind == NC_ITEM_SYNC) {
      status = nc_answer(nc, 0, &world);
    }
  }
  if (status == NC_ALARMED) {
    nc_alarm alarm = NC_INIT(nc_alarm);
    nc_alarm_get(nc, 0, &alarm);
    printf("line %u: %s %s %s\n", (unsigned)alarm.source.line, alarm.code, alarm.message, alarm.detail.s);
  }
  printf("%.3f mm. %s\n", length, nc_status_text(status));
  free(memory);
  return status == NC_ENDED ? 0 : 1;
}
