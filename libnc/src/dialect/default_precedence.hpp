// SPDX-License-Identifier: Apache-2.0
// The rows of precedence.hpp that hold in every family that has the functions and no row of its own for them. They are those of M700; the other manuals
// say of a few of these blocks what becomes of them, and of the rest nothing.
#pragma once

#include "dialect/precedence.hpp"
#include "dialect/table.hpp"

namespace nc {

extern const Table<PrecedenceRow> kDefaultPrecedence;
extern const Table<BarredRow> kDefaultBarred;
/// The modes of kDefaultBarred: in no other one the table needs to be looked through.
inline constexpr unsigned kDefaultBarringModes = kInPolarCommand | kInFigure | kInSpaceArc | kInExponential;

}  // namespace nc
