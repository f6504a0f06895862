// Busts (heads on shoulders, closed below) and faces (disks: the front of such a head, cut off in
// front of the ears). Heads are about one unit tall, look along z and stand along y.

#include <array>

#include "shapes/classes/classes.hh"

namespace layout_embedding::shapes {

namespace {

struct Head {
    const char* name;
    double width;
    double length;
    double jaw;
    double jaw_width;
    double chin;
    double nose;
    double nose_width;
    double brow;
    double cheeks;
    double lips;
    double eyes;
    double ears;
    double neck;
    double shoulders;
    double turn;
    double nod;
    /// 0 none, 1 short cap, 2 long, 3 bun.
    int hair;
    double beard;
};

const std::array<Head, 10> kHeads{{
    {"adult", 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0, 0, 0, 0},
    {"woman", 0.95, 0.98, 0.92, 0.88, 0.8, 0.82, 0.85, 0.5, 1.1, 1.25, 1.12, 0.85, 0.8, 0.85, 10, 4,
     3, 0},
    {"child", 1.04, 1.0, 0.78, 0.92, 0.6, 0.62, 0.95, 0.4, 1.4, 1.1, 1.25, 1.1, 0.7, 0.72, -8, 0, 1,
     0},
    {"old_man", 0.98, 1.02, 1.06, 1.0, 1.3, 1.35, 1.15, 1.5, 0.8, 0.7, 0.9, 1.35, 0.95, 0.95, 6, 3,
     0, 0.5},
    {"philosopher", 1.02, 1.0, 1.05, 1.06, 1.0, 1.15, 1.1, 1.3, 0.9, 0.8, 0.95, 1.0, 1.1, 1.1, -14,
     6, 1, 1.2},
    {"girl", 0.98, 0.98, 0.84, 0.86, 0.7, 0.7, 0.82, 0.4, 1.25, 1.2, 1.2, 0.8, 0.7, 0.74, 14, -4, 2,
     0},
    {"boxer", 1.06, 0.98, 1.04, 1.22, 1.3, 0.85, 1.45, 1.5, 1.1, 1.15, 0.85, 1.15, 1.5, 1.3, 0, 8,
     1, 0},
    {"long_face", 0.88, 1.04, 1.22, 0.86, 1.2, 1.3, 0.85, 1.1, 0.8, 0.9, 0.95, 1.1, 0.9, 0.95, -10,
     -6, 0, 0},
    {"round_face", 1.14, 1.0, 0.92, 1.22, 0.8, 0.8, 1.2, 0.7, 1.7, 1.1, 0.9, 1.0, 1.25, 1.12, 4, 0,
     1, 0},
    {"statue", 0.97, 1.0, 1.0, 0.98, 1.05, 1.1, 0.95, 0.9, 0.9, 1.05, 1.05, 0.9, 1.0, 1.05, 22, 2,
     2, 0},
}};

Figure head_figure(Index member, bool face)
{
    const Head& head = kHeads[member];
    Figure figure;
    Solid& solid = figure.solid;
    const Frame skull = face ? Frame{} : Frame{}.turned_y(head.turn).turned_x(head.nod);
    const double w = head.width;
    const double l = head.length;
    const double jaw = head.jaw;

    // Skull, face and jaw.
    solid.ellipsoid(skull.moved(0, 0.13, -0.06 * l), {0.36 * w, 0.38, 0.44 * l}, {});
    solid.ellipsoid(skull.moved(0, -0.12 * jaw, 0.11), {0.295 * w, 0.36 * jaw, 0.28}, {0.2});
    solid.sweep({{skull.point(-0.2 * w * head.jaw_width, -0.27 * jaw, 0.04), 0.1},
                 {skull.point(-0.1 * w * head.jaw_width, -0.4 * jaw, 0.24), 0.1},
                 {skull.point(0.1 * w * head.jaw_width, -0.4 * jaw, 0.24), 0.1},
                 {skull.point(0.2 * w * head.jaw_width, -0.27 * jaw, 0.04), 0.1}},
                {0.22});
    const Frame chin = skull.moved(0, -0.43 * jaw, 0.315);
    solid.ellipsoid(chin, {0.085, 0.065, 0.055 + 0.02 * head.chin}, {0.1});
    for (const double side : {1.0, -1.0}) {
        solid.ellipsoid(skull.moved(0.17 * w * side, -0.09, 0.25),
                        Vec3(0.1, 0.08, 0.06) * std::sqrt(head.cheeks), {0.16});
    }
    // Brows, sockets below them, eyes.
    for (const double side : {1.0, -1.0}) {
        solid.sweep({{skull.point(0.05 * w * side, 0.115, 0.36), 0.03},
                     {skull.point(0.14 * w * side, 0.14, 0.345 + 0.012 * head.brow), 0.034},
                     {skull.point(0.22 * w * side, 0.115, 0.28), 0.03}},
                    {0.08});
        solid.ellipsoid(skull.moved(0.14 * w * side, 0.035, 0.425), {0.08, 0.045, 0.075}, {0.07});
        solid.cut_last();
        solid.ellipsoid(skull.moved(0.135 * w * side, 0.035, 0.288),
                        Vec3(0.068, 0.048, 0.07) * head.eyes, {0.018});
    }
    // Nose.
    const double n = head.nose;
    const Frame tip = skull.moved(0, -0.125, 0.385 + 0.1 * n);
    solid.sweep({{skull.point(0, 0.08, 0.32), 0.045},
                 {skull.point(0, -0.02, 0.355 + 0.015 * n), 0.05},
                 {skull.point(0, -0.12, 0.37 + 0.03 * n), 0.058}},
                {0.06});
    solid.sweep({{skull.point(0, 0.09, 0.36), 0.034},
                 {skull.point(0, -0.01, 0.385 + 0.035 * n), 0.034},
                 {tip.origin, 0.042 + 0.006 * head.nose_width}},
                {0.06});
    for (const double side : {1.0, -1.0}) {
        solid.ellipsoid(skull.moved(0.05 * head.nose_width * side, -0.145, 0.37 + 0.045 * n),
                        Vec3(0.034, 0.032, 0.045), {0.035});
    }
    // Lips, parted by a groove.
    const double y = -0.265 * (0.4 + 0.6 * jaw);
    solid.sweep({{skull.point(-0.105, y, 0.33), 0.018},
                 {skull.point(0, y + 0.026, 0.385), 0.024 + 0.006 * head.lips},
                 {skull.point(0.105, y, 0.33), 0.018}},
                {0.045});
    solid.sweep({{skull.point(-0.085, y - 0.01, 0.335), 0.018},
                 {skull.point(0, y - 0.036, 0.378), 0.024 + 0.009 * head.lips},
                 {skull.point(0.085, y - 0.01, 0.335), 0.018}},
                {0.04});
    solid.sweep({{skull.point(-0.09, y + 0.002, 0.375), 0.012},
                 {skull.point(0, y - 0.004, 0.425), 0.014},
                 {skull.point(0.09, y + 0.002, 0.375), 0.012}},
                {0.03});
    solid.cut_last();
    if (head.beard > 0.0) {
        solid.sweep(
            {{skull.point(-0.2 * w, -0.25 * jaw, 0.12), 0.1},
             {skull.point(-0.08, -0.46 * jaw, 0.26), 0.09 + 0.03 * head.beard},
             {skull.point(0, -0.46 * jaw - 0.1 * head.beard, 0.3), 0.07 + 0.02 * head.beard},
             {skull.point(0.08, -0.46 * jaw, 0.26), 0.09 + 0.03 * head.beard},
             {skull.point(0.2 * w, -0.25 * jaw, 0.12), 0.1}},
            {0.07});
    }

    figure.landmark("nose_tip", tip.origin, tip.direction(0, -0.1, 1));
    figure.landmark("nose_bridge", skull.point(0, 0.075, 0.33), skull.z());
    figure.landmark("forehead", skull.point(0, 0.21, 0.1), skull.z());
    figure.landmark("chin", chin.origin, chin.direction(0, -0.15, 1));
    figure.landmark("upper_lip", skull.point(0, y + 0.032, 0.35), skull.z());
    figure.landmark("lower_lip", skull.point(0, y - 0.042, 0.35), skull.z());
    for (const double side : {1.0, -1.0}) {
        figure.landmark(side_name(side, "eye"), skull.point(0.135 * w * side, 0.042, 0.28),
                        skull.z());
        figure.landmark(side_name(side, "eye_outer"), skull.point(0.2 * w * side, 0.03, 0.2),
                        skull.direction(0.35 * side, 0, 1));
        figure.landmark(side_name(side, "eye_inner"), skull.point(0.06 * w * side, 0.035, 0.28),
                        skull.z());
        figure.landmark(side_name(side, "brow"), skull.point(0.14 * w * side, 0.14, 0.3),
                        skull.direction(0, 0.1, 1));
        figure.landmark(side_name(side, "nostril"),
                        skull.point(0.045 * head.nose_width * side, -0.145, 0.37),
                        skull.direction(side, -0.1, 0.6));
        figure.landmark(side_name(side, "mouth"), skull.point(0.108 * side, y, 0.26),
                        skull.direction(0.12 * side, 0, 1));
        figure.landmark(side_name(side, "cheek"), skull.point(0.17 * w * side, -0.1, 0.2),
                        skull.direction(0.3 * side, 0, 1));
        figure.landmark(side_name(side, "jaw"),
                        skull.point(0.18 * w * head.jaw_width * side, -0.3 * jaw, 0.1),
                        skull.direction(0.8 * side, -0.4, 0.35));
    }
    if (face) {
        // The rim runs in front of the ears, from the hair line to below the chin.
        const Frame rim = skull.turned_x(4);
        figure.cut = CutPlane{rim.point(0, 0, 0.02), -rim.z()};
        const Vec3 middle = rim.point(0, 0.0, 0.02);
        figure.landmark_on_rim("rim_top", middle, rim.y());
        figure.landmark_on_rim("rim_bottom", middle, -rim.y());
        figure.landmark_on_rim("left_rim", middle, rim.x());
        figure.landmark_on_rim("right_rim", middle, -rim.x());
        figure.detail = 0.017;
        return figure;
    }

    // Ears.
    const double e = head.ears;
    for (const double side : {1.0, -1.0}) {
        const Frame ear =
            skull.moved(0.34 * w * side, 0.0, -0.02).turned_y(-side * 28).turned_x(-8);
        solid.sweep({{ear.point(0.0, -0.1 * e, 0.01), 0.026 * e},
                     {ear.point(0.02 * side, -0.02 * e, -0.05 * e), 0.028 * e},
                     {ear.point(0.03 * side, 0.08 * e, -0.065 * e), 0.03 * e},
                     {ear.point(0.02 * side, 0.12 * e, -0.01 * e), 0.03 * e},
                     {ear.point(0.0, 0.07 * e, 0.03 * e), 0.028 * e}},
                    {0.03});
        // The shell fills the loop.
        solid.ellipsoid(ear.moved(-0.01 * side, 0.02 * e, -0.01 * e), {0.05, 0.12 * e, 0.075 * e},
                        {0.03});
        figure.landmark(side_name(side, "ear"), ear.point(0.02 * side, 0.08 * e, -0.05 * e),
                        ear.direction(0.7 * side, 0.5, -0.5));
    }
    // Hair.
    if (head.hair > 0) {
        solid.ellipsoid(skull.moved(0, 0.2, -0.15 * l), {0.405 * w, 0.385, 0.45 * l}, {0.03});
        if (head.hair == 2) {
            for (const double side : {1.0, -1.0}) {
                solid.sweep({{skull.point(0.3 * w * side, 0.15, -0.16), 0.13},
                             {skull.point(0.32 * w * side, -0.2, -0.18), 0.13},
                             {skull.point(0.24 * w * side, -0.5, -0.2), 0.1}},
                            {0.06});
            }
            solid.sweep({{skull.point(0, 0.1, -0.3), 0.25}, {skull.point(0, -0.45, -0.25), 0.2}},
                        {0.1});
        }
        if (head.hair == 3) {
            solid.ellipsoid(skull.moved(0, 0.42, -0.42), {0.16, 0.15, 0.15}, {0.06});
        }
    }
    // Neck, shoulders, chest and a small base.
    const double nk = head.neck;
    const Frame chest = Frame{}.moved(0, -1.0, -0.12);
    solid.sweep({{skull.point(0, -0.15, -0.08), 0.2 * nk},
                 {chest.point(0, 0.38, 0.0), 0.19 * nk},
                 {chest.point(0, 0.12, -0.02), 0.23 * nk}},
                {0.12});
    const double sh = head.shoulders;
    solid.sweep({{chest.point(-0.5 * sh, 0.0, 0), 0.17},
                 {chest.point(-0.2 * sh, 0.1, 0), 0.2},
                 {chest.point(0.2 * sh, 0.1, 0), 0.2},
                 {chest.point(0.5 * sh, 0.0, 0), 0.17}},
                {0.18});
    solid.ellipsoid(chest.moved(0, -0.12, 0.04), {0.5 * sh, 0.3, 0.24}, {0.14});
    solid.revolution(chest.moved(0, -0.56, 0),
                     {{0, -0.1}, {0.26, -0.1}, {0.26, -0.05}, {0.12, 0.06}, {0.12, 0.3}, {0, 0.3}},
                     0.05, {0.07});
    figure.landmark("crown", skull.point(0, 0.13, -0.08), skull.y());
    figure.landmark("back_of_head", skull.point(0, 0.05, -0.06), -skull.z());
    figure.landmark("neck_back", chest.point(0, 0.28, 0.0), {0, 0.1, -1});
    figure.landmark("neck_front", chest.point(0, 0.3, 0.0), {0, 0, 1});
    figure.landmark("chest", chest.point(0, -0.1, 0.04), {0, 0, 1});
    figure.landmark("back", chest.point(0, -0.05, 0), {0, 0, -1});
    for (const double side : {1.0, -1.0}) {
        figure.landmark(side_name(side, "shoulder"), chest.point(0.5 * sh * side, 0, 0),
                        {side, 0.2, 0});
        figure.landmark(side_name(side, "base"), chest.point(0.2 * side, -0.63, 0), {side, 0, 0});
    }
    figure.landmark("base_front", chest.point(0, -0.63, 0), {0, 0, 1});
    figure.landmark("base_bottom", chest.point(0, -0.63, 0), {0, -1, 0});
    figure.detail = 0.022;
    return figure;
}

ShapeClass head_class(const char* name, const char* title, int boundary_loops,
                      Figure (*build)(Index))
{
    ShapeClass result{name, title, 0, boundary_loops, {}, build};
    for (const Head& head : kHeads) {
        result.members.emplace_back(head.name);
    }
    return result;
}

}  // namespace

ShapeClass busts()
{
    return head_class("bust", "Busts", 0, [](Index member) { return head_figure(member, false); });
}

ShapeClass faces()
{
    return head_class("face", "Faces", 1, [](Index member) { return head_figure(member, true); });
}

}  // namespace layout_embedding::shapes
