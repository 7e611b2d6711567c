/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file nc.h
 * libnc: NC program text in, one set of axis positions per servo cycle out. This header is the whole public API.
 *
 * C11, no dependencies, no operating system. See examples/2_drive.c for a whole control in one file.
 */
#ifndef NC_NC_H
#define NC_NC_H
#include "nc/control.h"
#include "nc/restart.h"
#include "nc/run.h"
#endif
