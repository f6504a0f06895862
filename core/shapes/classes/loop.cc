// Things with holes: rings (genus 1), spectacles (genus 2) and pretzels (genus 3).

#include <array>

#include "shapes/classes/classes.hh"

namespace layout_embedding::shapes {

namespace {

struct Ring {
    const char* name;
    double band;
    /// Thicker towards the stone by this factor, and wider along the finger.
    double shoulder;
    double width;
    double stone;
    double stone_height;
    /// Corners of the stone's outline; 0 for a round one.
    int corners;
    /// The band winds up and down.
    double wave;
    double side_stones;
};

const std::array<Ring, 8> kRings{{
    {"solitaire", 0.09, 1.2, 1.2, 0.26, 0.2, 8, 0, 0},
    {"signet", 0.1, 2.0, 2.2, 0.36, 0.1, 0, 0, 0},
    {"band", 0.1, 1.1, 2.6, 0.16, 0.08, 0, 0, 0.1},
    {"emerald", 0.09, 1.3, 1.4, 0.32, 0.18, 4, 0, 0.13},
    {"wave", 0.085, 1.1, 1.2, 0.2, 0.16, 6, 0.09, 0},
    {"trilogy", 0.09, 1.2, 1.3, 0.24, 0.16, 8, 0, 0.19},
    {"crown", 0.11, 1.4, 1.6, 0.28, 0.26, 5, 0.05, 0.12},
    {"pearl", 0.08, 1.0, 1.1, 0.25, 0.25, 0, 0, 0},
}};

/// The ring lies in the x-y plane, its stone on top.
Figure ring_figure(Index member)
{
    const Ring& ring = kRings[member];
    Figure figure;
    Solid& solid = figure.solid;
    const Frame plane;
    std::vector<Knot> band;
    const int count = 24;
    for (int i = 0; i < count; ++i) {
        const double angle = 360.0 * i / count;
        const double up = 0.5 + 0.5 * sine(angle);
        band.push_back({{cosine(angle), sine(angle), ring.wave * sine(4 * angle)},
                        ring.band * (1.0 + (ring.shoulder - 1.0) * up * up)});
    }
    solid.closed_sweep(band, {}, {plane, {1, 1, ring.width}}, 2);
    // The stone stands on the top of the ring, along y.
    const double s = ring.stone;
    const double top = 1.0 + 0.5 * ring.band * ring.shoulder;
    const Frame stone = plane.moved(0, top + 0.5 * ring.stone_height, 0).turned_x(-90);
    if (ring.corners == 0) {
        solid.ellipsoid(stone, {s, s, 0.9 * ring.stone_height + 0.04}, {0.08});
    } else {
        Profile outline;
        for (int i = 0; i < ring.corners; ++i) {
            const double angle = 360.0 * (i + 0.5) / ring.corners;
            outline.push_back({(s - 0.03) * cosine(angle), (s - 0.03) * sine(angle)});
        }
        solid.extrusion(stone, outline, 0.5 * ring.stone_height, 0.04, {0.06});
        solid.ellipsoid(stone.moved(0, 0, 0.5 * ring.stone_height), {0.75 * s, 0.75 * s, 0.1},
                        {0.03});
    }
    if (ring.side_stones > 0.0) {
        for (const double side : {-1.0, 1.0}) {
            const double angle = 90 - side * (18 + 60 * s);
            solid.ellipsoid(plane.moved(1.05 * cosine(angle), 1.05 * sine(angle), 0),
                            Vec3::Constant(ring.side_stones), {0.05});
        }
    }
    figure.landmark("stone_top", stone.origin, {0, 1, 0});
    figure.landmark("left_stone", stone.origin, {1, 0, 0});
    figure.landmark("right_stone", stone.origin, {-1, 0, 0});
    figure.landmark("stone_front", stone.origin, {0, 0, 1});
    figure.landmark("stone_back", stone.origin, {0, 0, -1});
    const struct {
        const char* name;
        double angle;
    } places[] = {{"left_upper", 36},    {"left", 0},    {"left_lower", -45}, {"bottom", -90},
                  {"right_lower", -135}, {"right", 180}, {"right_upper", 144}};
    for (const auto& [name, angle] : places) {
        const Vec3 out(cosine(angle), sine(angle), 0);
        const Vec3 center = out + Vec3(0, 0, ring.wave * sine(4 * angle));
        figure.landmark(std::string(name) + "_outer", center, out);
        figure.landmark(std::string(name) + "_inner", center, -out);
    }
    figure.landmark("top_inner", {0, 1, 0}, {0, -1, 0});
    figure.detail = 0.026;
    return figure;
}

struct Spectacles {
    const char* name;
    double width;
    double height;
    /// Of the outline: 2 round, more for boxes.
    double squareness;
    double rim;
    double bridge;
    double bridge_height;
    double temple;
    double temple_angle;
    double tilt;
};

const std::array<Spectacles, 8> kSpectacles{{
    {"round", 0.5, 0.5, 0.0, 0.055, 0.24, 0.12, 1.5, 2, 0},
    {"square", 0.56, 0.42, 0.7, 0.075, 0.2, 0.16, 1.5, 4, 0},
    {"reading", 0.5, 0.28, 0.5, 0.05, 0.24, 0.06, 1.4, 8, 0},
    {"pilot", 0.56, 0.48, 0.3, 0.05, 0.2, 0.22, 1.6, 3, 14},
    {"thick", 0.54, 0.44, 0.5, 0.11, 0.2, 0.14, 1.5, 0, 0},
    {"cat_eye", 0.56, 0.38, 0.3, 0.08, 0.22, 0.14, 1.5, 4, -16},
    {"folded", 0.5, 0.42, 0.2, 0.06, 0.24, 0.12, 1.2, 70, 0},
    {"oval", 0.58, 0.4, 0.0, 0.055, 0.2, 0.1, 1.5, 6, 6},
}};

Figure spectacles_figure(Index member)
{
    const Spectacles& glasses = kSpectacles[member];
    Figure figure;
    Solid& solid = figure.solid;
    const double center = 0.5 * glasses.bridge + glasses.width + glasses.rim;
    const double r = glasses.rim;
    for (const double side : {1.0, -1.0}) {
        const Frame rim =
            Frame{}.moved(side * center, 0, 0).turned_y(side * 6).turned_z(-side * glasses.tilt);
        const auto at = [&](double angle) {
            // A circle pushed out towards its bounding box.
            const double c = cosine(angle);
            const double s = sine(angle);
            const double most = std::max(std::abs(c), std::abs(s));
            const double push = 1.0 + glasses.squareness * 0.6 * (1.0 / most - 1.0);
            return rim.point(side * glasses.width * push * c, glasses.height * push * s, 0);
        };
        std::vector<Knot> knots;
        for (int i = 0; i < 24; ++i) {
            knots.push_back({at(15.0 * i), r});
        }
        solid.closed_sweep(knots, {0.06}, {rim, {1, 1, 0.8}}, 2);
        // Temples leave backwards at the outer upper corner, and bend down behind the ear.
        const Vec3 hinge = at(24) + Vec3(side * 0.4 * r, 0, 0);
        const Frame temple = Frame{hinge, Frame{}.axes}.turned_y(-side * glasses.temple_angle);
        const double l = glasses.temple;
        const double t = std::min(r, 0.07);
        const Vec3 tip = temple.point(0, -0.34, -l);
        solid.sweep({{temple.point(0, 0, 0.02), 1.1 * t},
                     {temple.point(0.02 * side, 0, -0.1), t},
                     {temple.point(0, 0.0, -0.6 * l), 0.9 * t},
                     {temple.point(0, -0.06, -0.82 * l), t},
                     {tip, 1.1 * t}},
                    {0.05});
        figure.landmark(side_name(side, "temple_tip"), tip, temple.direction(0, -0.7, -0.6));
        figure.landmark(side_name(side, "temple_middle"), temple.point(0, 0, -0.6 * l), temple.y());
        figure.landmark(side_name(side, "hinge"), temple.point(0, 0, 0),
                        temple.direction(side, 0.2, 0.4));
        // Around each rim, in turn on its outside and towards the lens: with fewer, edges of a
        // layout would have to lead all the way around the rims, since no two may join the same
        // landmarks.
        const struct {
            const char* outside;
            const char* inside;
            double angle;
        } places[] = {{"rim_top", "lens_top", 90},
                      {"rim_outer", "lens_outer", 330},
                      {"rim_bottom", "lens_bottom", 270},
                      {"rim_nose", "lens_nose", 200}};
        for (const auto& [outside, inside, angle] : places) {
            const Vec3 out =
                rim.direction(side * glasses.width * cosine(angle), glasses.height * sine(angle), 0)
                    .normalized();
            figure.landmark(side_name(side, outside), at(angle), out);
            figure.landmark(side_name(side, inside), at(angle), -out);
        }
        figure.landmark(side_name(side, "rim_front"), at(235), rim.z());
    }
    const double y = glasses.bridge_height;
    const double half = 0.5 * glasses.bridge + 0.8 * r + 0.05;
    solid.sweep({{{-half, y, 0}, r}, {{0, y + 0.06, 0.03}, 0.9 * r}, {{half, y, 0}, r}}, {0.06});
    figure.landmark("bridge_top", {0, y + 0.06, 0.03}, {0, 1, 0});
    figure.landmark("bridge_bottom", {0, y + 0.06, 0.03}, {0, -1, 0});
    figure.detail = 0.028;
    return figure;
}

struct Pretzel {
    const char* name;
    double width;
    double height;
    double radius;
    double belly;
    double lift;
    double lower;
    double flat;
};

const std::array<Pretzel, 8> kPretzels{{
    {"classic", 1.0, 0.8, 0.13, 1.5, 0.06, 1.0, 1.0},
    {"thin", 1.0, 0.85, 0.085, 1.3, 0.04, 1.0, 1.0},
    {"plump", 1.05, 0.8, 0.17, 1.25, 0.08, 1.0, 0.8},
    {"wide", 1.3, 0.75, 0.13, 1.5, 0.05, 1.0, 1.0},
    {"tall", 0.9, 1.05, 0.12, 1.6, 0.06, 1.05, 1.0},
    {"flat", 1.05, 0.85, 0.15, 1.3, 0.02, 1.0, 0.55},
    {"swabian", 1.1, 0.85, 0.1, 2.1, 0.07, 1.0, 1.0},
    {"twisted", 1.0, 0.9, 0.11, 1.4, 0.09, 0.95, 1.0},
}};

/// The pretzel lies in the x-y plane, its thick belly below, its crossing in the middle.
Figure pretzel_figure(Index member)
{
    const Pretzel& pretzel = kPretzels[member];
    Figure figure;
    Solid& solid = figure.solid;
    const double w = pretzel.width;
    const double h = pretzel.height;
    const double r = pretzel.radius;
    const Squash flat{Frame{}, {1, 1, pretzel.flat}};
    // Both arms: from the belly's middle out and up around one loop, down across the middle to
    // the belly on the other side.
    for (const double side : {1.0, -1.0}) {
        const double z = side * pretzel.lift;
        const auto at = [&](double x, double y, double depth) {
            return Vec3(side * w * x, h * y, depth);
        };
        solid.sweep({{at(0.0, -0.86, 0), pretzel.belly * r},
                     {at(0.42, -0.74, 0), 0.94 * pretzel.belly * r},
                     {at(0.86, -0.24, 0), 0.5 * (1.1 + 0.8 * pretzel.belly) * r},
                     {at(0.98, 0.36, 0), 1.1 * r},
                     {at(0.66, 0.8, 0), r},
                     {at(0.26, 0.6, 0.3 * z), 0.95 * r},
                     {at(0.0, 0.14, z), 0.95 * r},
                     {at(-0.26, -0.24, z), 0.92 * r},
                     {at(-0.5, -0.62 * pretzel.lower, 0.6 * r), 0.95 * r}},
                    {0.05}, flat, 6);
        figure.landmark(side_name(side, "loop_outer"), at(0.98, 0.36, 0), {side, 0.1, 0});
        figure.landmark(side_name(side, "loop_inner"), at(0.98, 0.36, 0), {-side, -0.1, 0});
        figure.landmark(side_name(side, "loop_top"), at(0.66, 0.8, 0), {0, 1, 0});
        figure.landmark(side_name(side, "loop_under_top"), at(0.66, 0.8, 0), {0, -1, 0});
        figure.landmark(side_name(side, "arm_upper"), at(0.26, 0.6, 0.3 * z), {-side, 0.7, 0});
        figure.landmark(side_name(side, "arm_lower"), at(0.26, 0.6, 0.3 * z), {side, -0.7, 0});
        figure.landmark(side_name(side, "loop_front"), at(0.86, -0.24, 0), {0, 0, 1});
        figure.landmark(side_name(side, "loop_back"), at(0.86, -0.24, 0), {0, 0, -1});
    }
    for (const double side : {1.0, -1.0}) {
        figure.landmark(side_name(side, "end"),
                        {side * 0.5 * w, -0.62 * pretzel.lower * h, 0.6 * r},
                        {side * 0.2, -0.1, 1});
    }
    figure.landmark("belly_bottom", {0, -0.86 * h, 0}, {0, -1, 0});
    figure.landmark("belly_inner", {0, -0.86 * h, 0}, {0, 1, 0});
    figure.landmark("belly_front", {0, -0.86 * h, 0}, {0, 0, 1});
    figure.landmark("belly_back", {0, -0.86 * h, 0}, {0, 0, -1});
    figure.landmark("crossing_front", {0, 0.14 * h, 0}, {0, 0, 1});
    figure.landmark("crossing_back", {0, 0.14 * h, 0}, {0, 0, -1});
    figure.detail = 0.03;
    return figure;
}

template <typename Items>
ShapeClass loop_class(const char* name, const char* title, int genus, const Items& items,
                      Figure (*build)(Index))
{
    ShapeClass result{name, title, genus, 0, {}, build};
    for (const auto& item : items) {
        result.members.emplace_back(item.name);
    }
    return result;
}

}  // namespace

ShapeClass rings()
{
    return loop_class("ring", "Rings", 1, kRings, ring_figure);
}

ShapeClass spectacles()
{
    return loop_class("spectacles", "Spectacles", 2, kSpectacles, spectacles_figure);
}

ShapeClass pretzels()
{
    return loop_class("pretzel", "Pretzels", 3, kPretzels, pretzel_figure);
}

}  // namespace layout_embedding::shapes
