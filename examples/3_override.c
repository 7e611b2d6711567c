/* SPDX-License-Identifier: Apache-2.0 */
/* 3. Override and hold: the operator turns the feed override to 50 %, presses feed hold, and goes on with cycle start. What is shown
 * comes from nc_outputs: the state, and why nothing moves. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "nc/nc.h"

static const char program[] = "G21 G90 G94\nG01 X100. F6000\nM30\n"; /* 100 mm/s */

static nc_control* nc;
static nc_inputs in;
static nc_outputs out;

/* Runs the machine for so many milliseconds; true when it is without an alarm afterwards. */
static bool run_ms(int ms) {
  for (int i = 0; i < ms; ++i) {
    nc_feed(nc, 100);
    if (nc_cycle(nc, &in, &out) != NC_OK) return false;
    in.fin = out.strobe != 0; /* M30 is complete at once */
  }
  return out.state != NC_STATE_ALARM;
}

static void show(const char* what) {
  static const char* const states[] = {"idle", "running", "hold", "stopped", "alarm", "manual"};
  printf("%-12s %-8s feed %4.0f mm/min, override %3.0f %%%s\n", what, states[out.state], out.feed_mm_min, 100 * out.feed_override,
         out.cause == NC_CAUSE_FEED_HOLD ? ", waits for the end of feed hold" : "");
}

int main(void) {
  nc_config config;
  nc_config_init(&config);
  config.system[0].axis[0].max_velocity = 250;
  config.system[0].axis[0].max_acceleration = 2000;
  const size_t size = nc_memory_required(&config);
  void* memory = aligned_alloc(64, (size + 63) / 64 * 64);
  nc_status status = NC_E_MEMORY;
  nc = memory != NULL ? nc_create(&config, memory, size, &status) : NULL;
  unsigned file = 0;
  if (nc != NULL) status = nc_program_add_text(nc, "PART", program, strlen(program), &file);
  if (status == NC_OK) status = nc_program_select(nc, 0, file);
  if (status != NC_OK) {
    fprintf(stderr, "cannot start: %s\n", nc_status_text(status));
    return 1;
  }
  nc_inputs_init(&in); /* overrides of 100 % */
  nc_outputs_init(&out);
  bool good = run_ms(10);
  in.cycle_start = true; /* the operator presses the button, and lets go of it below */
  good = good && run_ms(10);
  in.cycle_start = false;
  good = good && run_ms(200);
  show("started");
  in.feed_override = 0.5;
  good = good && run_ms(200);
  show("override");
  in.feed_hold = true; /* the axes slow down along the path and stop on it */
  good = good && run_ms(200);
  show("feed hold");
  const double held_at = out.command.v[0];
  good = good && run_ms(500) && out.command.v[0] == held_at;
  in.feed_hold = false;
  in.feed_override = 1;
  good = good && run_ms(10) && out.command.v[0] == held_at; /* the end of the hold alone does not move the machine: it waits for cycle start */
  in.cycle_start = true;
  good = good && run_ms(200);
  show("cycle start");
  good = good && run_ms(2000);
  show("end");
  printf("X %.3f\n", out.command.v[0]);
  free(memory);
  return good && out.state == NC_STATE_IDLE ? 0 : 1;
}
