// SPDX-License-Identifier: Apache-2.0
// Sentences for what drives report. See drive_fault.hpp.
#include "hal/drive_fault.hpp"

#include <cstdio>

namespace nc::hal {
namespace {

struct EmergencyRow {
  unsigned code, mask;
  const char* text;
};
// CiA 402-2, table "error codes", and CiA 301, table "emergency error codes". A row for a single code comes before the row for the class to which the code
// belongs, because the first row that matches counts.
constexpr EmergencyRow kEmergencies[] = {
    {0x2310, 0xFFFF, "continuous over current"},
    {0x2320, 0xFFFF, "short circuit or earth leakage"},
    {0x3110, 0xFFFF, "mains over-voltage"},
    {0x3120, 0xFFFF, "mains under-voltage"},
    {0x3210, 0xFFFF, "DC link over-voltage"},
    {0x3220, 0xFFFF, "DC link under-voltage"},
    {0x3331, 0xFFFF, "field circuit interrupted"},
    {0x4210, 0xFFFF, "device too hot"},
    {0x4310, 0xFFFF, "drive too hot"},
    {0x5400, 0xFF00, "power section"},
    {0x5500, 0xFF00, "data memory"},
    {0x6100, 0xFF00, "internal software"},
    {0x6320, 0xFFFF, "a parameter is wrong"},
    {0x7120, 0xFFFF, "motor"},
    {0x7121, 0xFFFF, "motor blocked"},
    {0x7122, 0xFFFF, "motor error or commutation"},
    {0x7300, 0xFF00, "sensor"},
    {0x8110, 0xFFFF, "CAN overrun, a message is lost"},
    {0x8120, 0xFFFF, "CAN error passive"},
    {0x8130, 0xFFFF, "the heartbeat of the control did not come"},
    {0x8140, 0xFFFF, "recovered from bus off"},
    {0x8150, 0xFFFF, "two nodes with one identifier"},
    {0x8210, 0xFFFF, "PDO not processed, its length is wrong"},
    {0x8220, 0xFFFF, "PDO is too long"},
    {0x8611, 0xFFFF, "following error"},
    {0x8612, 0xFFFF, "limit of the reference"},
    {0x8700, 0xFF00, "SYNC does not come in time"},
    {0x1000, 0xF000, "generic error"},
    {0x2000, 0xF000, "current"},
    {0x3000, 0xF000, "voltage"},
    {0x4000, 0xF000, "temperature"},
    {0x5000, 0xF000, "device hardware"},
    {0x6000, 0xF000, "device software"},
    {0x7000, 0xF000, "additional modules"},
    {0x8000, 0xFE00, "monitoring of the communication"},
    {0x8000, 0xF000, "monitoring"},
    {0x9000, 0xF000, "external error"},
    {0xF000, 0xF000, "additional functions"},
};

const char* trouble_text(DriveTrouble trouble) {
  switch (trouble) {
    case DriveTrouble::kHeartbeat: return "its heartbeat does not come";
    case DriveTrouble::kNoPosition: return "its positions do not come";
    case DriveTrouble::kRestarted: return "its node has started anew by itself";
    case DriveTrouble::kNotEnabled: return "it does not come to \"operation enabled\"";
    case DriveTrouble::kLeftEnabled: return "it has left \"operation enabled\" by itself";
    case DriveTrouble::kNoCommand: return "the scan has given no positions in time";
    case DriveTrouble::kNotConfigured: return "its node cannot be set up, the log says why";
    case DriveTrouble::kHoming: return "its homing has failed";
    case DriveTrouble::kTwice: return "two nodes send under its identifier";
    case DriveTrouble::kJump: return "the scan asks for a jump that the axis cannot do";
    case DriveTrouble::kProbe: return "its touch probe has latched a place at which the axis was not";
    case DriveTrouble::kHomingNotBegun: return "its homing does not begin: its status stays that of the one before";
    case DriveTrouble::kStep: return "its position has jumped farther than the axis can move: home it again";
    case DriveTrouble::kNone:
    case DriveTrouble::kEmergency: break;
  }
  return "";
}

}  // namespace

const char* emergency_text(unsigned emergency) noexcept {
  if ((emergency & 0xFF00) == 0xFF00) return "of the manufacturer";
  for (const EmergencyRow& row : kEmergencies)
    if ((emergency & row.mask) == row.code) return row.text;
  return emergency == 0 ? "error reset or no error" : "unknown code";
}

std::string drive_fault_text(std::uint32_t code) {
  const auto trouble = static_cast<DriveTrouble>(code >> 24 & 0x7F);
  if (trouble != DriveTrouble::kEmergency) return trouble_text(trouble);
  char text[160];
  std::snprintf(text, sizeof text, "EMCY %04Xh: %s (error register %02Xh)", code & 0xFFFF, emergency_text(code & 0xFFFF), code >> 16 & 0xFF);
  return text;
}

}  // namespace nc::hal
