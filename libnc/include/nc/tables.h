/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file tables.h
 * The tables of a control: parameters, work and tool offsets, tool life, variables and their names; and how to read them as the machine
 * has them.
 * Threads, errors and ownership are as in control.h, unless a function says otherwise.
 */
#ifndef NC_TABLES_H
#define NC_TABLES_H

#include "nc/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- parameters ----------------------------------------------------------------------------------------------- */

/**
 * Set a control parameter by the manual's number or name. Feeder thread.
 * @param control the control
 * @param system part system, from 0; a parameter that all part systems share (M700 #1121, #1129, #1303, #1304, #8105) is set for all of them,
 *             whichever one is given
 * @param key  "1078", "1267/bit0", "UNIT*10", DGSHAPE "interpretation", ...; a parameter of the dialect that has no effect in this control
 *             is accepted and kept
 * @param axis name of the axis for a parameter that each axis has for itself, 0 = all axes
 * @param text value as text, in the manual's units: a number, or a word of the manual ("B" for #1003)
 * @return NC_OK; NC_E_NOT_FOUND: no such key; NC_E_ARGUMENT: no such part system or axis, a pointer is NULL, or the value is out of the parameter's range;
 *         NC_E_MEMORY: too many parameters are set
 */
NC_API nc_status nc_parameter_set(nc_control* control, unsigned system, const char* key, char axis, const char* text);

/**
 * Value of a parameter that is a number. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param key  as for nc_parameter_set()
 * @param axis name of the axis, 0 = the value for all axes
 * @param value receives the value, in the manual's units; 0 when it was never set
 * @return NC_OK; NC_E_NOT_FOUND: no such key; NC_E_ARGUMENT: no such part system or axis, or a pointer is NULL
 */
NC_API nc_status nc_parameter_get(const nc_control* control, unsigned system, const char* key, char axis, double* value);

/** Parameters that a host can ask for by what they do, whatever the dialect calls them. */
typedef enum nc_parameter_role {
  NC_PARAMETER_DECIMAL_TYPE_2 = 0,   /**< a number without a decimal point is in mm (M700 5.3) */
  NC_PARAMETER_DWELL_POINT = 1,      /**< the decimal point of P in a dwell is not ignored (M700 8.1) */
  NC_PARAMETER_TOOL_MEMORY = 2,      /**< memory type of tool offsets, 1 or 2 (M700 12.1) */
  NC_PARAMETER_POWER_OFF_CLEARS = 3, /**< power off clears the common variables of NC_VARIABLES_CLEARED (M700 13.4) */
  NC_PARAMETER_DIGIT_FEED = 4        /**< speed of the one-digit feed F1; the parameters of F2 to F5 have the keys that follow (M700 7.3) */
} nc_parameter_role;

/**
 * Key of a parameter that a host asks for by what it does. Any thread.
 * @param control the control
 * @param role what the parameter does
 * @param key receives its key in the control's dialect, as nc_parameter_set() takes it
 * @return NC_OK; NC_E_NOT_FOUND: the dialect has no such parameter; NC_E_ARGUMENT: an argument is not valid
 */
NC_API nc_status nc_parameter_key_get(const nc_control* control, nc_parameter_role role, char key[24]);

/**
 * How lengths and positions without a decimal point are read, with the parameters that are set. Feeder thread.
 * @param control the control
 * @param system index of the part system
 * @param whole receives true: in whole mm, inch or deg (X10 is 10 mm); false: in the least unit of the dialect (X10 is 0.010 mm)
 * @return NC_OK; NC_E_ARGUMENT: an argument is not valid
 */
NC_API nc_status nc_undotted_get(const nc_control* control, unsigned system, bool* whole);

/**
 * Give the next parameter that is set. Parameters have places, numbered in the order in which they were first set; the search begins at place
 * `from`. A parameter of which only one bit was set ("1267/bit0") is given as a whole; one whose setting has been taken back is left out. Feeder
 * thread.
 * @param control the control
 * @param system part system, from 0
 * @param from place at which the search begins, from 0
 * @param place receives the place of the parameter: the next search begins at place + 1
 * @param key receives its key
 * @param axis receives the name of its axis, 0 = all axes
 * @param value receives its value in the manual's units, when the value is a number or one character
 * @param text receives a value of two or more characters, at most 63; else ""
 * @return NC_OK; NC_E_NOT_FOUND: there is none; NC_E_ARGUMENT: no such part system, or a pointer is NULL
 */
NC_API nc_status nc_parameter_next(const nc_control* control, unsigned system, unsigned from, unsigned* place, char key[24], char* axis,
                                   double* value, char text[64]);

#define NC_NOTE_KEYS 4 /**< most parameters that one note names */

/** A note about parameters that are set. */
typedef struct nc_parameter_note {
  NC_STRUCT_SIZE(nc_parameter_note); /**< see NC_STRUCT_SIZE */
  char text[200];             /**< the sentence */
  char axis;                  /**< name of the axis that it is about, 0 = of none in particular */
  uint8_t key_count;          /**< parameters that the sentence names, 1 to NC_NOTE_KEYS */
  char key[NC_NOTE_KEYS][24]; /**< their keys in the order of the sentence, as nc_parameter_set() takes them, without the bit: "2007" */
} nc_parameter_note;

/**
 * Notes about the parameters that are set, one sentence each: which of them have no effect on this machine, and where a time constant and not
 * the feed limits the speed (docs/motion.md, "Behind interpolation"). They come in the order of the parameter numbers, then of the axes. Feeder
 * thread.
 * @param control the control
 * @param system part system, from 0
 * @param index of the note, from 0
 * @param note receives it
 * @return NC_OK; NC_E_NOT_FOUND: there is no such note, `index` is behind the last one; NC_E_ARGUMENT: no such part system, or `note` is NULL or its
 *         struct_size is not valid
 */
NC_API nc_status nc_parameter_note_row(const nc_control* control, unsigned system, unsigned index, nc_parameter_note* note);

/* ---- offsets -------------------------------------------------------------------------------------------------- */

/**
 * Set one entry of the work offset tables. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param index 0 = external, 1..6 = G54..G59, 100+n = G54.1 Pn
 * @param axis of the configuration, from 0
 * @param value mm or deg, between -1e9 and 1e9
 * @return NC_OK; NC_E_ARGUMENT: no such part system, index or axis, or the value is out of range
 */
NC_API nc_status nc_work_offset_set(nc_control* control, unsigned system, unsigned index, unsigned axis, double value);

/**
 * Read one entry of the work offset tables. It is the value after all blocks that have been read so far, executed or not. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param index as for nc_work_offset_set()
 * @param axis of the configuration, from 0
 * @param value receives it, mm or deg
 * @return NC_OK; NC_E_ARGUMENT: no such part system, index or axis, or `value` is NULL
 */
NC_API nc_status nc_work_offset_get(const nc_control* control, unsigned system, unsigned index, unsigned axis, double* value);

/** Tool offset columns (M700 12.1). In memory type I all columns but NC_TOOL_LENGTH are unused. */
typedef enum nc_tool_column { NC_TOOL_LENGTH = 0, NC_TOOL_LENGTH_WEAR = 1, NC_TOOL_RADIUS = 2, NC_TOOL_RADIUS_WEAR = 3 } nc_tool_column;

/**
 * Set one entry of the tool offset table, which all part systems share. Feeder thread.
 * @param control the control
 * @param number of the set, 1 to nc_config::tool_offsets
 * @param column nc_tool_column
 * @param value mm, between -1e9 and 1e9
 * @return NC_OK; NC_E_ARGUMENT: no such set or column, or the value is out of range
 */
NC_API nc_status nc_tool_offset_set(nc_control* control, unsigned number, nc_tool_column column, double value);

/**
 * Read one entry of the tool offset table. It is the value after the blocks that part system 0 has read and the others have executed. Feeder
 * thread.
 * @param control the control
 * @param number of the set, 1 to nc_config::tool_offsets
 * @param column nc_tool_column
 * @param value receives it, mm
 * @return NC_OK; NC_E_ARGUMENT: no such set or column, or `value` is NULL
 */
NC_API nc_status nc_tool_offset_get(const nc_control* control, unsigned number, nc_tool_column column, double* value);

/* ---- tool life ------------------------------------------------------------------------------------------------ */

/** Number of tools whose life can be managed. */
#define NC_TOOL_LIVES 200

/** Columns of the table of tool life (M700 13.5.5, #60501 to #64700). */
typedef enum nc_life_column {
  NC_LIFE_GROUP = 0,     /**< number of its group, 1 to 99999999; 0 = no tool is registered here */
  NC_LIFE_TOOL = 1,      /**< number of the tool, 0 to 99999999 */
  NC_LIFE_FLAGS = 2,     /**< bits 4, 5: what is counted: 0 minutes of cutting, 1 mounts, 2 uses; the others are given back as they are; 0 to 255 */
  NC_LIFE_STATUS = 3,    /**< 0 not used, 1 in use, 2 its life has ended, 3 and 4 not to be used */
  NC_LIFE_LIFE = 4,      /**< its life in minutes (0 to 4000) or times (0 to 9999); 0 = without end */
  NC_LIFE_USED = 5,      /**< what of it has been used, in the same range */
  NC_LIFE_LENGTH = 6,    /**< number of its offset for the length */
  NC_LIFE_RADIUS = 7,    /**< number of its offset for the radius */
  NC_LIFE_AUXILIARY = 8  /**< for the machine's own use */
} nc_life_column;

/**
 * Set one entry of the table of tool life, which all part systems share. Feeder thread.
 * @param control the control
 * @param number of the tool in the table, 1 to NC_TOOL_LIVES: the tools of a group are used in this order
 * @param column nc_life_column
 * @param value in the range and the unit of its column; whole numbers but for minutes and NC_LIFE_AUXILIARY. NC_LIFE_FLAGS says whether NC_LIFE_LIFE and NC_LIFE_USED are
 *        minutes or times and so which range they have: it is set before them, and that of a tool with a group cannot become minutes while they are beyond those
 * @return NC_OK; NC_E_ARGUMENT: no such number or column, or the value is out of range
 */
NC_API nc_status nc_tool_life_set(nc_control* control, unsigned number, nc_life_column column, double value);

/**
 * Read one entry of the table of tool life, as nc_tool_offset_get() does. Feeder thread.
 * @param control the control
 * @param number of the tool in the table, 1 to NC_TOOL_LIVES
 * @param column nc_life_column
 * @param value receives it, in the unit of its column
 * @return NC_OK; NC_E_ARGUMENT: no such number or column, or `value` is NULL
 */
NC_API nc_status nc_tool_life_get(const nc_control* control, unsigned number, nc_life_column column, double* value);

/**
 * Offline: a tool of the table has cut for so long. Counts it as the control does by itself where it executes the program: for the tool wherever it is registered now,
 * up to the end of the range of minutes, and with the end of its life. Nothing is counted where the tool is registered no more, or where its life is counted in times.
 * Feeder thread.
 * @param control the control
 * @param number of the tool in the table, 1 to NC_TOOL_LIVES, as NC_CONTROL_TOOL_LIFE gives it: the place in which it was when it came into the spindle
 * @param tool its number, as NC_CONTROL_TOOL_LIFE gives it
 * @param minutes of cutting, 0 or more: unit minutes
 * @return NC_OK; NC_E_ARGUMENT: no such number, or `minutes` is negative or not finite
 */
NC_API nc_status nc_tool_life_cut(nc_control* control, unsigned number, uint32_t tool, double minutes);

/* ---- variables ------------------------------------------------------------------------------------------------ */

/**
 * Set a local or common variable. Feeder thread.
 * @param control the control
 * @param system part system, from 0; a variable that all part systems share is set for all of them, whichever one is given
 * @param number of the variable; local ones are those of the program that is being read
 * @param value its value, finite; a variable has no unit
 * @param vacant true: it becomes vacant (#0), and `value` does not count
 * @return NC_OK; NC_E_ARGUMENT: no such part system, or `value` is no finite number; NC_E_NOT_FOUND: no such variable, or a system variable
 */
NC_API nc_status nc_variable_set(nc_control* control, unsigned system, uint32_t number, double value, bool vacant);

/**
 * Read a local or common variable. It is the value after the blocks that this part system has read so far, executed or not; for a shared variable
 * the blocks that the other part systems have executed count, too. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param number of the variable; local ones are those of the program that is being read
 * @param value receives its value, which has no unit
 * @param vacant receives whether it is vacant (#0)
 * @return NC_OK; NC_E_ARGUMENT: no such part system, or a pointer is NULL; NC_E_NOT_FOUND: no such variable, or a system variable
 */
NC_API nc_status nc_variable_get(const nc_control* control, unsigned system, uint32_t number, double* value, bool* vacant);

/**
 * Give the first common variable, with a number of `from` or above, that is not vacant. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param from number at which the search begins
 * @param number receives its number: the next search begins at number + 1
 * @param value receives its value, which has no unit
 * @return NC_OK; NC_E_NOT_FOUND: there is none; NC_E_ARGUMENT: no such part system, or a pointer is NULL
 */
NC_API nc_status nc_variable_next(const nc_control* control, unsigned system, uint32_t from, uint32_t* number, double* value);

/**
 * Name of a common variable (SETVN; M700 13.5.5). Feeder thread.
 * @param control the control
 * @param number of the variable
 * @param name receives the name with its NUL; "" = the variable has no name
 * @return NC_OK; NC_E_ARGUMENT: a pointer is NULL
 */
NC_API nc_status nc_variable_name_get(const nc_control* control, uint32_t number, char name[8]);

/**
 * Give a common variable a name, for example one that was kept while the power was off. Feeder thread.
 * @param control the control
 * @param number of the variable, one of NC_VARIABLES_NAMED
 * @param name at most 7 capital letters and digits, a letter first, and not beginning with a function's (SINUS); "" takes it away. Copied.
 * @return NC_OK; NC_E_ARGUMENT: the variable can have no name, or the name is not a valid one
 */
NC_API nc_status nc_variable_name_set(nc_control* control, uint32_t number, const char* name);

/* ---- all of them, as the machine has them --------------------------------------------------------------------- */

/**
 * Called by nc_look_executed(). During the call variables, their names, offsets and parameters have the values that they have after the blocks
 * which the machine has executed: these are the values to keep while the power is off. After the call they have again the values after the
 * blocks that were read ahead. The function must only read. Feeder thread.
 * @param user what nc_look_executed() was given
 * @param control the control
 */
typedef void (*nc_look)(void* user, const nc_control* control);

/**
 * Call `look` while the tables have the values after the executed blocks (see nc_look). Feeder thread.
 * @param control the control
 * @param look called once, before this function returns
 * @param user handed to it
 */
NC_API void nc_look_executed(nc_control* control, nc_look look, void* user);

#ifdef __cplusplus
}
#endif
#endif
