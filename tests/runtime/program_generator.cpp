// SPDX-License-Identifier: Apache-2.0
// See program_generator.hpp.
#include "program_generator.hpp"

#include <cmath>
#include <cstdio>

namespace nc::test {
namespace {

constexpr double kBox = 90.0;  // mm around zero, within which the programs cut
constexpr double kPi = 3.14159265358979323846;

// As "12.345": every number has a decimal point, so that no rule for numbers without one changes it.
std::string number(double value) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.3f", value);
  return buffer;
}

}  // namespace

void ProgramGenerator::line(const std::string& text) {
  program_.text += text + "\n";
  ++lines_;
}

double ProgramGenerator::draw(double from, double to) {
  const double t = std::uniform_real_distribution<double>(from, to)(random_);
  return std::round(t * 1000.0) / 1000.0;
}

std::string ProgramGenerator::feed() {
  return " F" + std::to_string(200 + draw(12000u)) + ".";
}

void ProgramGenerator::go(double x, double y, double z) {
  x_ = x;
  y_ = y;
  z_ = z;
}

GeneratedProgram ProgramGenerator::make(unsigned groups) {
  using Group = void (ProgramGenerator::*)();
  static constexpr Group kGroups[] = {
      &ProgramGenerator::lines,       &ProgramGenerator::lines,
      &ProgramGenerator::arcs,        &ProgramGenerator::arcs,
      &ProgramGenerator::helix,       &ProgramGenerator::radius_arc,
      &ProgramGenerator::incremental, &ProgramGenerator::drilling,
      &ProgramGenerator::auxiliary,   &ProgramGenerator::dwell,
      &ProgramGenerator::subprogram,  &ProgramGenerator::polygon_macro,
      &ProgramGenerator::input_loop,  &ProgramGenerator::input_at_line,
      &ProgramGenerator::outputs,     &ProgramGenerator::probe,
      &ProgramGenerator::contour,     &ProgramGenerator::work_system,
      &ProgramGenerator::tool_length, &ProgramGenerator::exact_stop,
      &ProgramGenerator::stops,       &ProgramGenerator::optional_blocks,
      &ProgramGenerator::goto_loop,   &ProgramGenerator::input_macro,
      &ProgramGenerator::corners,
  };
  line("%");
  line("O1");
  line("G90 G17 G21 G40 G49 G80 G94 G64 G54");
  line("G0 X0. Y0. Z0.");
  line("G1 X0.001 F1000.");
  line("X0.");
  for (unsigned i = 0; i < groups; ++i) (this->*kGroups[draw(static_cast<unsigned>(std::size(kGroups)))])();
  line("M30");
  line("O2000 (MOVES RELATIVE TO WHERE IT IS CALLED)");
  line("G91 G1 X1.5 Y-0.75 F2500.");
  line("G2 X2. Y0. I1. J0.");
  line("G0 X-3.5 Y0.75");
  line("G90");
  line("M99");
  line("O2100 (POLYGON: A CORNERS, B RADIUS, C AND D CENTRE, F FEED)");
  line("#33=0");
  line("WHILE [#33 LE #1] DO1");
  line("G1 X[#3+#2*COS[#33*360./#1]] Y[#7+#2*SIN[#33*360./#1]] F#9");
  line("#33=#33+1");
  line("END1");
  line("M99");
  line("O2200 (STEPS OF A UNTIL INPUT #1000 IS ON)");
  line("WHILE [#1000 EQ 0] DO1");
  line("#500=#500+#1");
  line("G91 G1 X#1 Y[#1/2.] F#9");
  line("M50");
  line("END1");
  line("G90");
  line("M99");
  line("%");
  return std::move(program_);
}

void ProgramGenerator::lines() {
  const unsigned count = 1 + draw(8u);
  for (unsigned i = 0; i < count; ++i) {
    const double x = draw(-kBox, kBox), y = draw(-kBox, kBox), z = draw(-kBox, kBox);
    switch (draw(5u)) {
      case 0:
        line("G0 X" + number(x) + " Y" + number(y) + " Z" + number(z));
        go(x, y, z);
        break;
      case 1:
        line("G1 X" + number(x) + feed());
        go(x, y_, z_);
        break;
      case 2:
        line("G1 Y" + number(y) + " Z" + number(z) + feed());
        go(x_, y, z);
        break;
      case 3: {  // a run of short segments
        for (unsigned k = 1; k <= 20; ++k) {
          x_ = std::round((x_ + 0.2) * 1000) / 1000;
          y_ = std::round((y_ + 0.15 * std::sin(k * 0.4)) * 1000) / 1000;
          line("G1 X" + number(x_) + " Y" + number(y_) + (k == 1 ? feed() : ""));
        }
        break;
      }
      default:
        line("G1 X" + number(x) + " Y" + number(y) + " Z" + number(z) + feed());
        go(x, y, z);
        break;
    }
  }
}

// A closed contour with chamfers and roundings at its corners.
void ProgramGenerator::corners() {
  line("G17 G91 G1 X9. ,C" + number(draw(0.5, 3.0)) + feed());
  if (draw(2u) != 0) line("#501=#501+1");
  line("Y8. ,R" + number(draw(0.5, 3.0)));
  line(std::string(draw(2u) != 0 ? "M50 " : "") + "X-9. ,R" + number(draw(0.5, 3.0)) + feed());
  line("Y-8.");
  line("G90");
}

// Arcs that are given by their centre; the end lies on the circle to the last digit of the program.
void ProgramGenerator::arcs() {
  static const char* const kPlanes[] = {"G17", "G18", "G19"};
  const unsigned plane = draw(3u);
  line(kPlanes[plane]);
  double* const first[] = {&x_, &z_, &y_};
  double* const second[] = {&y_, &x_, &z_};
  static const char kFirst[] = "XZY", kSecond[] = "YXZ", kI[] = "IKJ", kJ[] = "JIK";
  for (unsigned i = 0, n = 1 + draw(3u); i < n; ++i) {
    const double radius = draw(1.0, 30.0), angle = draw(0.0, 360.0) * kPi / 180;
    const double ci = std::round(radius * std::cos(angle) * 1000) / 1000,
                 cj = std::round(radius * std::sin(angle) * 1000) / 1000;
    std::string text = draw(2u) ? "G2" : "G3";
    if (draw(4u) != 0) {  // a half circle, whose end is exact; otherwise a whole circle
      *first[plane] += 2 * ci;
      *second[plane] += 2 * cj;
      text += std::string(" ") + kFirst[plane] + number(*first[plane]) + " " + kSecond[plane] +
              number(*second[plane]);
    }
    text += std::string(" ") + kI[plane] + number(ci) + " " + kJ[plane] + number(cj) + feed();
    line(text);
  }
  line("G17");
  line("G1 X0. Y0. Z0." + feed());
  go(0, 0, 0);
}

void ProgramGenerator::helix() {
  const double radius = draw(2.0, 15.0), z = draw(-20.0, 20.0);
  line(std::string(draw(2u) ? "G2" : "G3") + " I" + number(radius) + " Z" + number(z) + feed());
  z_ = z;
  line("G3 X" + number(x_ + 2 * radius) + " I" + number(radius) + " Z" + number(z + 3));
  x_ += 2 * radius;
  z_ = z + 3;
  line("G0 X0. Y0.");
  go(0, 0, z_);
}

void ProgramGenerator::radius_arc() {
  const double chord = draw(2.0, 20.0), radius = draw(chord / 2 + 0.5, 40.0);
  x_ += chord;
  line(std::string(draw(2u) ? "G2" : "G3") + " X" + number(x_) + " R" + number(draw(3u) ? radius : -radius) +
       feed());
  line("G1 X" + number(x_ = 0));
}

void ProgramGenerator::incremental() {
  line("G91");
  for (unsigned i = 0; i < 3; ++i)
    line("G1 X" + number(draw(-5.0, 5.0)) + " Y" + number(draw(-5.0, 5.0)) + feed());
  line("G90 G1 X" + number(x_) + " Y" + number(y_));
}

void ProgramGenerator::drilling() {
  line("G0 Z20.");
  z_ = 20;
  static const char* const kCycles[] = {"G81", "G82", "G83"};
  const unsigned cycle = draw(3u);
  std::string text = std::string(draw(2u) ? "G98 " : "G99 ") + kCycles[cycle] + " X" +
                     number(draw(-kBox, kBox)) + " Y" + number(draw(-kBox, kBox)) + " Z-5. R3.";
  if (cycle == 1) text += " P20";
  if (cycle == 2) text += " Q2.5";
  line(text + feed());
  for (unsigned i = 0, n = draw(3u); i < n; ++i)
    line("X" + number(draw(-kBox, kBox)) + " Y" + number(draw(-kBox, kBox)));
  line("G80");
  line("G0 X0. Y0. Z20.");
  go(0, 0, 20);
}

void ProgramGenerator::auxiliary() {
  switch (draw(4u)) {
    case 0:
      line("S" + std::to_string(500 + draw(5000u)) + " M3");
      break;
    case 1:
      line("T" + std::to_string(1 + draw(8u)) + " M6");
      break;
    case 2:
      line("M8");
      break;
    default:
      x_ = draw(-kBox, kBox);
      line("G1 X" + number(x_) + feed() + " M9");
      break;
  }
}

void ProgramGenerator::dwell() {
  line("G4 P" + std::to_string(1 + draw(80u)));
}

void ProgramGenerator::subprogram() {
  line("M98 P2000 L" + std::to_string(1 + draw(3u)));
}

void ProgramGenerator::polygon_macro() {
  line("G65 P2100 A" + std::to_string(3 + draw(9u)) + ". B" + number(draw(2.0, 20.0)) + " C" +
       number(draw(-20.0, 20.0)) + " D" + number(draw(-20.0, 20.0)) + feed());
  line("G0 X" + number(x_) + " Y" + number(y_) + " Z" + number(z_));
}

// A loop that runs while an input is off; the script switches the input on at the M code of the last turn.
void ProgramGenerator::input_loop() {
  const unsigned turns = 1 + draw(4u);
  m50_ += turns;
  program_.script.push_back("when M 50 #" + std::to_string(m50_) + ": in0 = 1");
  line("WHILE [#1000 EQ 0] DO1");
  line("#500=#500+1");
  line("G91 G1 X0.25 Y0.1" + feed());
  line("M50");
  line("END1");
  line("G90 G1 X" + number(x_) + " Y" + number(y_));
  input_off();
}

// The same inside a macro.
void ProgramGenerator::input_macro() {
  m50_ += 2 + draw(3u);
  program_.script.push_back("when M 50 #" + std::to_string(m50_) + ": in0 = 1");
  line("G65 P2200 A" + number(draw(0.1, 0.5)) + feed());
  line("G1 X" + number(x_) + " Y" + number(y_));
  input_off();
}

// Switches the input off for the next loop, at a line that is a move.
void ProgramGenerator::input_off() {
  const double y = y_ > 0 ? y_ - 5 : y_ + 5;
  program_.script.push_back("when line " + std::to_string(lines_ + 1) + ": in0 = 0");
  line("G1 Y" + number(y) + " F3000.");
  line("G1 Y" + number(y_));
}

// An input word changes while a line is executed, and is read after it.
void ProgramGenerator::input_at_line() {
  const unsigned value = draw(1u << 20);
  program_.script.push_back("when line " + std::to_string(lines_ + 1) +
                            ": word_in = " + std::to_string(value));
  const double z = z_ > 0 ? z_ - 4 : z_ + 4;
  line("G1 Z" + number(z) + " F2000.");
  z_ = z;
  line("#501=#501+#1033");
  line("IF [#1033 GT 500000] GOTO " + std::to_string(next_label_));
  line("G1 X" + number(x_ + 1) + " F2000.");
  line("N" + std::to_string(next_label_++) + " G1 X" + number(x_) + " F2500.");
}

void ProgramGenerator::outputs() {
  line("#1100=" + std::to_string(draw(2u)));
  line("#1133=" + std::to_string(draw(100000u)));
  line("#510=#510+#1133");
}

// Touches the solid at X150, keeps the place in a variable, and goes back.
void ProgramGenerator::probe() {
  line("G0 X130. Y" + number(y_));
  line("G31 X170. F" + std::to_string(300 + draw(3000u)) + ".");
  line("#" + std::to_string(520 + draw(10u)) + "=#5061");
  line("G91 G1 X-2.5 F2000.");
  line("G90 G0 X" + number(x_));
}

// A square with the tool on its outside.
void ProgramGenerator::contour() {
  const double side = draw(20.0, 60.0);
  line("G0 X-30. Y-30.");
  line("G1 G42 D1 X0. Y-10." + feed());
  line("X0. Y0.");
  line("X" + number(side));
  line("Y" + number(side));
  line("X0.");
  line("Y-10.");
  line("G1 G40 X-30. Y-30.");
  line("G0 X0. Y0.");
  go(0, 0, z_);
}

void ProgramGenerator::work_system() {
  line("G10 L2 P2 X" + number(draw(-10.0, 10.0)) + " Y" + number(draw(-10.0, 10.0)) + " Z" +
       number(draw(-10.0, 10.0)));
  line("G55 G0 X" + number(draw(-50.0, 50.0)) + " Y" + number(draw(-50.0, 50.0)));
  line("G1 X0. Y0." + feed());
  line("G54 G0 X" + number(x_) + " Y" + number(y_) + " Z" + number(z_));
}

void ProgramGenerator::tool_length() {
  line("G43 H2 G0 Z" + number(z_));
  line("G1 X" + number(draw(-kBox, kBox)) + feed());
  line("G49 G0 X" + number(x_) + " Z" + number(z_));
}

void ProgramGenerator::exact_stop() {
  line(draw(2u) ? "G61" : "G64");
  line("G9 G1 X" + number(x_ = draw(-kBox, kBox)) + feed());
}

void ProgramGenerator::stops() {
  line(draw(2u) ? "M0" : "M1");
}

void ProgramGenerator::optional_blocks() {
  line("/ G1 X" + number(draw(-kBox, kBox)) + " F4000.");
  line("/2 G1 Y" + number(draw(-kBox, kBox)) + " F4000.");
  line("G1 X" + number(x_) + " Y" + number(y_) + " F4000.");
}

void ProgramGenerator::goto_loop() {
  const std::string label = std::to_string(next_label_++);
  line("#100=0");
  line("N" + label + " G91 G1 Z0.2 F1500.");
  line("#100=#100+1");
  line("IF [#100 LT " + std::to_string(2 + draw(4u)) + "] GOTO " + label);
  line("G90 G1 Z" + number(z_));
}

}  // namespace nc::test
