/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file config.h
 * What a control is: its axes and part systems, its options and what a vendor adds. nc_create() takes it.
 */
#ifndef NC_CONFIG_H
#define NC_CONFIG_H

#include "nc/vendor.h"

#ifdef __cplusplus
extern "C" {
#endif

/** One axis. A limit of 0 means "no limit", so a control that only traces programs needs the name alone. Limits may be at most 1e12, positions must
 *  lie between -1e9 and 1e9. */
typedef struct nc_axis_config {
  char name;               /**< address letter, A B C U V W X Y Z */
  bool rotary;             /**< true: a rotary axis, in degrees; false: a linear axis, in mm */
  double rapid;            /**< rapid traverse rate, mm/s or deg/s; 0 = max_velocity */
  double max_velocity;     /**< mm/s or deg/s; it also clamps the cutting feed of the axis */
  double max_acceleration; /**< mm/s^2 or deg/s^2 */
  double max_jerk;         /**< mm/s^3 or deg/s^3 */
  double in_position;      /**< in-position width, mm or deg */
  bool soft_limited;       /**< true: soft_min and soft_max limit the axis; false: they mean nothing */
  double soft_min, soft_max; /**< stored stroke limits, machine coordinates, mm or deg */
  double reference[4];     /**< 1st to 4th reference position, machine coordinates, mm or deg */
  uint8_t spindle;         /**< a C axis: number (from 1) of the spindle that becomes this rotary axis while its servo is on (M700 10.5); 0 = no spindle */
  double reserved[8];      /**< for members of later versions, must be 0 */
} nc_axis_config;

/** One part system. */
/** What turns the tool where its length is compensated along its axis (G43.1, M700 12.3). */
typedef enum nc_tool_axis {
  NC_TOOL_AXIS_TURNED = 0,       /**< rotary axes of the part system: C and A, or C and B where there is no A. Their machine positions are the angles */
  NC_TOOL_AXIS_MECHANICAL_A = 1, /**< a head that is no axis of the part system ("mechanical axes"), as C and A: nc_inputs::tool_angle has the angles */
  NC_TOOL_AXIS_MECHANICAL_B = 2  /**< the same as C and B */
} nc_tool_axis;

typedef struct nc_system_config {
  uint8_t axis_count;      /**< 1..NC_MAX_AXES */
  nc_axis_config axis[NC_MAX_AXES]; /**< nothing of those behind axis_count is looked at */
  uint8_t spindle_count;   /**< 1..NC_MAX_SPINDLES; 0 = one */
  uint64_t spindle_unsigned; /**< bit n: the speed in nc_inputs::spindle[n] is measured without a sign, so a thread does not check in which
                                  direction this spindle turns */
  uint64_t tool_axis;      /**< nc_tool_axis; default NC_TOOL_AXIS_TURNED */
  double reserved[6];      /**< for members of later versions, must be 0 */
} nc_system_config;

/** How the machine moves along the path. */
typedef enum nc_motion_mode {
  NC_MOTION_TRAPEZOID = 0, /**< limits the velocity and the acceleration of each axis, but not its jerk. It is the value 0, which a cleared config has, because it
                                needs the fewest limits and the least memory */
  NC_MOTION_OPTIMAL = 1    /**< the shortest time within the limits of velocity, acceleration and jerk of every axis; all three must be set for each axis */
} nc_motion_mode;

/** A range of common variables that a machine has in addition to those of nc_config::variable_sets, for example #400 to #499. */
typedef struct nc_variable_range {
  uint32_t first, last;    /**< first and last variable number, 34 to 999999, at most 10000 variables; both 0 = the range is not used */
} nc_variable_range;

/** What a control is. Fill with nc_config_init(), then change what differs. */
typedef struct nc_config {
  NC_STRUCT_SIZE(nc_config); /**< see NC_STRUCT_SIZE; set by nc_config_init() */
  uint8_t dialect;         /**< nc_dialect */
  uint8_t system_count;    /**< 1..NC_MAX_SYSTEMS */
  nc_system_config system[NC_MAX_SYSTEMS]; /**< nothing of those behind system_count is looked at */
  double cycle_s;          /**< servo cycle, s, 1e-6..0.1; default 0.001 */
  uint32_t look_ahead;     /**< records in the ring between feeder and scan, power of two 64..65536; default 1024 (15 MB).
                                In the time-optimal mode a row of short lines runs at full speed only if the lines in the ring, each of which takes
                                two records, are together longer than the braking distance of the machine: lines of 1 um need 16384 records (89 MB) */
  uint32_t programs;       /**< entries of the program store, 1..65535; default 256 */
  uint32_t tool_offsets;   /**< number of tool offset sets, 1..999; default 200 */
  uint32_t work_offsets;   /**< number of extended work offsets: n of G54.1 P1..Pn, 0..300; default 96 */
  uint32_t variable_sets;  /**< number of common variables, as the option of the manual: 100, 200, 300 or 600 (M700 13.4); default 600 */
  bool extended_variables; /**< true: the common variables #900000 to #907399 of later models exist, too; default false */
  uint32_t window_bytes;   /**< bytes of program text that each part system holds in memory at once, 512..16777216; default 65536 */
  double max_feed_override; /**< largest value of nc_inputs::feed_override, 1..10 (1 = 100 %); default 2.0 */
  uint8_t motion_mode;     /**< nc_motion_mode; default NC_MOTION_TRAPEZOID (ncrtd and ncsim choose NC_MOTION_OPTIMAL where every axis has all limits) */
  double path_tolerance;   /**< mm, 0 or 1e-5..10; default 0.01. NC_MOTION_OPTIMAL: the largest distance by which corners between lines may leave the
                                programmed path; 0: the path is kept exactly, with a rest at each corner. NC_MOTION_TRAPEZOID: the largest distance by
                                which high-accuracy control rounds corners; 0: it rounds none */
  nc_variable_range variable_ranges[NC_VARIABLE_RANGES]; /**< further common variables, shared by all part systems. The ranges must not overlap one
                                another, the variables of the two options above, local variables or system variables */
  const nc_vendor_code* vendor_codes; /**< the vendor's own codes, `vendor_code_count` rows; copied by nc_create(). NULL = none */
  uint32_t vendor_code_count;         /**< rows of `vendor_codes`, 0 to NC_MAX_VENDOR_CODES */
  nc_alarm_text alarm_text;           /**< the host's function that replaces texts of the library; NULL = the library's texts are used */
  void* alarm_text_user;              /**< handed to `alarm_text` */
  const nc_kinematics* kinematics[NC_MAX_SYSTEMS]; /**< for each part system the joints that its axes are turned into; copied by nc_create().
                                NULL = the part system has no joints, its axes themselves are driven */
  uint32_t contour_blocks;            /**< blocks of the longest contour that the check of its walls takes (the parameter CONTOUR_CHECK of m700), 16 to 1000000;
                                default 3800 (1.5 MB for each part system; memory that no contour has needed is never written). A longer contour is an
                                alarm where the check is on */
  double retract_overlap;             /**< mm, 0 to 100; default 0. NC_MOTION_OPTIMAL: between two holes of a fixed cycle the tool goes on by so much beyond
                                its return level (R or the initial level) and passes from the retract into the traverse, and from there down, in one
                                curve each, without a rest. Where it is below that level the axes of the plane stand. 0: it stops at the level */
  double tap_most_apart;              /**< revolutions, 0.05 to 100; default 2. A spindle that is farther from what a synchronous tap commands does not
                                follow it: an alarm */
} nc_config;

/**
 * Set every member to its default: M700, one part system with X Y Z without limits. Any thread. It is for languages that cannot use the
 * inline function nc_config_init().
 * @param config receives the defaults; NULL does nothing
 * @param struct_size bytes of `config`, sizeof(nc_config); a number below 4 or above 65536 does nothing
 */
NC_API void nc_config_init_sized(nc_config* config, size_t struct_size);

/**
 * Set every member to its default, as nc_config_init_sized() does. Any thread.
 * @param config receives the defaults; NULL does nothing
 */
static inline void nc_config_init(nc_config* config) { nc_config_init_sized(config, sizeof(nc_config)); }

/** Which member of a configuration is refused, and why. */
typedef struct nc_config_fault {
  NC_STRUCT_SIZE(nc_config_fault); /**< see NC_STRUCT_SIZE */
  char field[64];          /**< the member, written as in C: "system[0].axis[2].max_velocity" */
  char reason[160];        /**< what the member has to be: "must be 0 to 1e12 mm/s or deg/s; 0 = no limit" */
} nc_config_fault;

/**
 * Check whether nc_create() accepts a configuration. Any thread; needs no control.
 * @param config the configuration
 * @param fault receives the first member that is refused; untouched when there is none. May be NULL.
 * @return NC_OK; NC_E_ARGUMENT when a member is refused, or `config` is NULL (then *fault is untouched)
 */
NC_API nc_status nc_config_check(const nc_config* config, nc_config_fault* fault);

/**
 * Check whether nc_create() accepts nc_config::variable_ranges[index]. Any thread; needs no control.
 * @param config the configuration with its options and other ranges
 * @param index of the range, 0 to NC_VARIABLE_RANGES - 1
 * @param taken receives the first number of the range that another variable has already; 0 when there is none, or the range itself is not valid.
 *              May be NULL.
 * @return NC_OK, also for a range that is not used; NC_E_ARGUMENT: the range is refused, `config` is NULL, or `index` is out of range
 */
NC_API nc_status nc_variable_range_check(const nc_config* config, unsigned index, uint32_t* taken);

#ifdef __cplusplus
}
#endif
#endif
