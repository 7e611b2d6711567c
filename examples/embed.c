/* SPDX-License-Identifier: Apache-2.0 */
/* A whole control in one C file: cuts a small part and prints where the axes are. In a firmware nc_feed() runs in a background task,
 * nc_cycle() in the servo interrupt, and the positions go to the drives. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "nc/nc.h"

static const char program[] =
    "G21 G90 G17 G94\n"
    "M03 S8000\n"
    "G00 X10. Y0. Z2.\n"
    "G01 Z-1. F600\n"
    "G03 I-10. F1200\n"            /* a full circle */
    "#1=0\n"
    "WHILE [#1 LT 360] DO1\n"      /* and six holes around it */
    "G81 X[30*COS[#1]] Y[30*SIN[#1]] Z-5. R2. F300\n"
    "#1=#1+60\n"
    "END1\n"
    "G80\n"
    "M30\n";

int main(void) {
  nc_config config;
  nc_config_init(&config); /* m700, one part system, X Y Z, 1 ms */
  for (int i = 0; i < 3; ++i) {
    config.system[0].axis[i].max_velocity = 250;      /* mm/s */
    config.system[0].axis[i].max_acceleration = 2000; /* mm/s2 */
  }
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
  nc_inputs_init(&in); /* nothing pressed, overrides of 100 % */
  nc_outputs_init(&out);
  in.cycle_start = true;
  long cycle = 0;
  do {
    nc_feed(nc, 100);
    nc_cycle(nc, &in, &out);
    in.fin = out.strobe != 0; /* M, S, T are complete at once */
    if (cycle++ % 500 == 0)
      printf("%7.3f s  X %8.3f  Y %8.3f  Z %8.3f  line %u\n", (double)cycle * config.cycle_s, out.command.v[0], out.command.v[1],
             out.command.v[2], (unsigned)out.source.line);
  } while (out.state != NC_STATE_ALARM && !(out.state == NC_STATE_IDLE && out.blocks > 0) && cycle < 1000000);

  printf("%s after %.3f s, %llu blocks, %.1f mm\n", out.state == NC_STATE_IDLE ? "end" : "stopped", out.run_s,
         (unsigned long long)out.blocks, out.path_length);
  free(memory);
  return out.state == NC_STATE_IDLE && out.blocks > 0 ? 0 : 2;
}
