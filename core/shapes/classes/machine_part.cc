// Machine parts: a base plate, a shaft below, a boss with a hexagonal head above and a lever to one
// side. Flat faces and round edges; a unit is about the size of the plate.

#include <algorithm>
#include <array>

#include "shapes/classes/classes.hh"

namespace layout_embedding::shapes {

namespace {

struct MachinePart {
    const char* name;
    /// Half width and half depth of the plate, and its thickness.
    double width;
    double depth;
    double plate;
    double boss;
    double boss_height;
    double hexagon;
    double hexagon_height;
    double shaft;
    double shaft_length;
    double collar;
    double lever;
    double lever_width;
    double lever_turn;
    double rounding;
};

const std::array<MachinePart, 8> kParts{{
    {"valve", 0.5, 0.5, 0.12, 0.26, 0.22, 0.24, 0.2, 0.15, 0.6, 0.24, 0.95, 0.13, 20, 0.03},
    {"tap", 0.38, 0.38, 0.1, 0.24, 0.4, 0.3, 0.14, 0.18, 0.35, 0.28, 1.15, 0.1, -12, 0.045},
    {"bolt", 0.42, 0.42, 0.08, 0.2, 0.12, 0.32, 0.28, 0.2, 1.2, 0.25, 0.62, 0.12, 0, 0.025},
    {"crank", 0.46, 0.36, 0.14, 0.22, 0.55, 0.2, 0.14, 0.14, 0.5, 0.22, 1.4, 0.12, 35, 0.035},
    {"bracket", 0.75, 0.4, 0.1, 0.2, 0.2, 0.22, 0.16, 0.12, 0.4, 0.17, 1.0, 0.16, 8, 0.03},
    {"knob", 0.4, 0.4, 0.16, 0.32, 0.3, 0.36, 0.22, 0.14, 0.8, 0.22, 0.7, 0.14, -30, 0.06},
    {"piston", 0.36, 0.5, 0.1, 0.18, 0.34, 0.2, 0.12, 0.24, 0.9, 0.33, 0.85, 0.1, 0, 0.03},
    {"stand", 0.7, 0.62, 0.09, 0.17, 0.8, 0.22, 0.18, 0.1, 0.25, 0.16, 1.1, 0.11, -22, 0.028},
}};

Profile rectangle(double x, double y)
{
    return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

Figure machine_part_figure(Index member)
{
    const MachinePart& part = kParts[member];
    Figure figure;
    Solid& solid = figure.solid;
    const double e = part.rounding;
    const double fillet = 1.5 * e;
    // Extrusions run along z of their frame: here up.
    const Frame base = Frame{}.turned_x(-90);
    solid.extrusion(base, rectangle(part.width - e, part.depth - e), 0.5 * part.plate, e, {});
    const double top = 0.5 * part.plate;
    const Frame upright;
    solid.revolution(upright,
                     {{0, 0},
                      {part.boss - e, 0},
                      {part.boss - e, top + part.boss_height},
                      {0, top + part.boss_height}},
                     e, {fillet});
    Profile hexagon;
    for (int i = 0; i < 6; ++i) {
        hexagon.push_back({(part.hexagon - e) * cosine(60 * i), (part.hexagon - e) * sine(60 * i)});
    }
    const double head = top + part.boss_height + e + 0.5 * part.hexagon_height;
    solid.extrusion(base.moved(0, 0, head), hexagon, 0.5 * part.hexagon_height, e, {fillet});
    // The shaft below, with a collar and a tapered end.
    const double length = part.shaft_length;
    solid.revolution(upright,
                     {{0, -length},
                      {0.55 * part.shaft - e, -length},
                      {part.shaft - e, -length + 0.4 * part.shaft},
                      {part.shaft - e, -0.5 * length},
                      {part.collar - e, -0.5 * length},
                      {part.collar - e, -0.5 * length + 0.12},
                      {part.shaft - e, -0.5 * length + 0.12},
                      {part.shaft - e, 0},
                      {0, 0}},
                     e, {fillet});
    // The lever leaves the boss along x and ends in a cylinder.
    const double reach = part.lever;
    const double height = top + 0.5 * part.boss_height;
    const double lw = part.lever_width;
    const Frame lever = upright.moved(0, height, 0).turned_y(part.lever_turn);
    const double thick = std::min(0.32 * part.boss_height, 0.09);
    solid.extrusion(lever.turned_x(-90),
                    {{0, -1.1 * lw}, {reach, -0.7 * lw}, {reach, 0.7 * lw}, {0, 1.1 * lw}}, thick,
                    e, {fillet});
    const double end_height = 0.16;
    solid.revolution(
        lever.moved(reach, 0, 0),
        {{0, -end_height}, {1.25 * lw, -end_height}, {1.25 * lw, end_height}, {0, end_height}}, e,
        {fillet});

    const double w = part.width - e;
    const double d = part.depth - e;
    const Vec3 corners[4] = {{w, 0, d}, {-w, 0, d}, {-w, 0, -d}, {w, 0, -d}};
    for (int i = 0; i < 4; ++i) {
        const Vec3 out(corners[i].x() > 0 ? 1 : -1, 0, corners[i].z() > 0 ? 1 : -1);
        const double y = 0.5 * part.plate;
        figure.landmark("plate_top_" + std::to_string(i + 1), corners[i] + Vec3(0, y, 0),
                        out + Vec3(0, 1, 0));
        figure.landmark("plate_bottom_" + std::to_string(i + 1), corners[i] - Vec3(0, y, 0),
                        out - Vec3(0, 1, 0));
    }
    for (int i = 0; i < 6; ++i) {
        const Frame out = upright.moved(0, head + 0.5 * part.hexagon_height, 0).turned_y(60 * i);
        figure.landmark("hexagon_" + std::to_string(i + 1), out.point(part.hexagon - e, 0, 0),
                        out.direction(1, 0.7, 0));
    }
    figure.landmark("head_top", {0, head, 0}, {0, 1, 0});
    figure.landmark("shaft_end", {0, -0.8 * length, 0}, {0, -1, 0});
    for (int i = 0; i < 4; ++i) {
        figure.landmark("collar_" + std::to_string(i + 1), {0, -0.5 * length + 0.06, 0},
                        {cosine(90 * i + 45), 0, sine(90 * i + 45)});
    }
    figure.landmark("lever_top", lever.point(reach, 0, 0), lever.y());
    figure.landmark("lever_bottom", lever.point(reach, 0, 0), -lever.y());
    figure.landmark("lever_end", lever.point(reach, 0, 0), lever.x());
    figure.detail = 0.022;
    return figure;
}

}  // namespace

ShapeClass machine_parts()
{
    ShapeClass result{"machine_part", "Machine parts", 0, 0, {}, machine_part_figure};
    for (const MachinePart& part : kParts) {
        result.members.emplace_back(part.name);
    }
    return result;
}

}  // namespace layout_embedding::shapes
