/* SPDX-License-Identifier: Apache-2.0 */
/* 2. Drive axes, a whole control in one file: one set-point per cycle for each axis. In a firmware nc_feed() runs in a background task and nc_cycle() in the servo
 * interrupt; here they take turns. The drives are simulated: each follows its set-point late, and its encoder is given back. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "nc/nc.h"

enum { kAxes = 3 };

static const char program[] =
    "G21 G90 G17 G94\n"
    "M03 S8000\n"
    "G00 X40. Y10.\n"
    "G01 Z-1. F600\n"
    "G03 I-10. F1200\n" /* a full circle */
    "G09 G01 X0. Y0.\n" /* exact stop: waits until the drives are there */
    "M30\n";

/* In each cycle a drive goes half of the distance to its set-point. */
static void drives_follow(nc_axes* actual, const nc_axes* command) {
  for (int i = 0; i < kAxes; ++i) actual->v[i] += 0.5 * (command->v[i] - actual->v[i]);
}

int main(void) {
  nc_config config;
  nc_config_init(&config); /* m700, one part system, X Y Z, 1 ms */
  for (int i = 0; i < kAxes; ++i) {
    config.system[0].axis[i].max_velocity = 250;      /* mm/s */
    config.system[0].axis[i].max_acceleration = 2000; /* mm/s2 */
    config.system[0].axis[i].max_jerk = 50000;        /* mm/s3 */
    config.system[0].axis[i].in_position = 0.01;      /* mm */
  }
  config.motion_mode = NC_MOTION_OPTIMAL; /* needs all three limits of every axis; the default, NC_MOTION_TRAPEZOID, needs less memory */
  const size_t size = nc_memory_required(&config);
  void* memory = aligned_alloc(64, (size + 63) / 64 * 64);
  nc_status status = NC_E_MEMORY;
  nc_control* nc = memory != NULL ? nc_create(&config, memory, size, &status) : NULL;
  unsigned file = 0;
  if (nc != NULL) status = nc_program_add_text(nc, "PART", program, strlen(program), &file);
  if (status == NC_OK) status = nc_program_select(nc, 0, file);
  if (status != NC_OK) {
    fprintf(stderr, "cannot start: %s\n", nc_status_text(status));
    return 1;
  }

  nc_inputs in;
  nc_outputs out;
  nc_inputs_init(&in);
  nc_outputs_init(&out);
  in.actual_valid = true;
  in.cycle_start = true; /* its rising edge starts the program */
  double lag = 0;
  long cycle = 0;
  do {
    nc_feed(nc, 100);
    status = nc_cycle(nc, &in, &out);
    drives_follow(&in.actual, &out.command);
    for (int i = 0; i < kAxes; ++i) {
      const double behind = fabs(out.command.v[i] - in.actual.v[i]);
      if (behind > lag) lag = behind;
    }
    in.fin = out.strobe != 0; /* M, S, T are complete at once */
  } while (status == NC_OK && out.state != NC_STATE_ALARM && !(out.state == NC_STATE_IDLE && out.blocks > 0) && ++cycle < 100000);

  printf("X %.3f Y %.3f Z %.3f after %.3f mm of path; the drives were up to %.2f mm behind\n", out.command.v[0], out.command.v[1],
         out.command.v[2], out.path_length, lag);
  free(memory);
  return out.state == NC_STATE_IDLE && out.blocks > 0 ? 0 : 1;
}
