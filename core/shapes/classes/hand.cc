// Right hands, fingers up along y, the palm towards z, the thumb at positive x. One unit is about
// the length of the palm.

#include <array>

#include "shapes/classes/classes.hh"

namespace layout_embedding::shapes {

namespace {

/// Angles in degrees.
struct FingerPose {
    /// Towards the thumb.
    double spread;
    /// At the three joints, towards the palm.
    double base;
    double middle;
    double tip;
};

struct Pose {
    const char* name;
    std::array<FingerPose, 4> fingers;
    /// Of the thumb: away from the palm's side, towards the palm, and at its two outer joints.
    double thumb_out;
    double thumb_in;
    double thumb_middle;
    double thumb_tip;
    /// Proportions: lengths of fingers and thickness.
    double length;
    double width;
    double wrist_bend;
};

constexpr FingerPose kCurled[4] = {
    {4, 68, 78, 40}, {0, 70, 80, 40}, {-4, 70, 78, 40}, {-9, 68, 74, 40}};

const std::array<Pose, 10> kPoses{{
    {"open",
     {{{9, 5, 8, 5}, {2, 4, 8, 5}, {-6, 5, 8, 5}, {-15, 6, 9, 5}}},
     42,
     18,
     12,
     10,
     1.0,
     1.0,
     0},
    {"relaxed",
     {{{6, 18, 28, 16}, {1, 24, 32, 18}, {-5, 28, 36, 20}, {-12, 30, 38, 22}}},
     32,
     32,
     20,
     22,
     0.98,
     1.02,
     -14},
    {"pointing",
     {{{3, 4, 6, 4}, kCurled[1], kCurled[2], kCurled[3]}},
     36,
     20,
     18,
     20,
     1.0,
     0.97,
     -8},
    {"victory",
     {{{13, 3, 5, 3}, {-7, 3, 5, 3}, kCurled[2], kCurled[3]}},
     24,
     40,
     24,
     20,
     1.04,
     0.92,
     0},
    {"spread",
     {{{19, -6, 4, 2}, {4, -4, 4, 2}, {-11, -5, 4, 2}, {-27, -4, 6, 3}}},
     58,
     2,
     4,
     0,
     1.06,
     0.9,
     10},
    {"claw",
     {{{12, -8, 62, 42}, {3, -6, 66, 44}, {-8, -6, 64, 44}, {-19, -8, 60, 42}}},
     46,
     22,
     30,
     38,
     1.0,
     1.06,
     -10},
    {"horns", {{{8, 2, 6, 4}, kCurled[1], kCurled[2], {-17, 2, 8, 5}}}, 52, 8, 8, 6, 1.0, 1.0, 0},
    {"child",
     {{{10, 8, 14, 8}, {2, 8, 14, 8}, {-7, 9, 14, 8}, {-17, 10, 14, 8}}},
     46,
     20,
     14,
     8,
     0.8,
     1.2,
     0},
    {"thumb_up",
     {{{4, 74, 80, 36}, {0, 76, 80, 36}, {-4, 76, 78, 36}, {-9, 74, 74, 36}}},
     18,
     -22,
     0,
     -8,
     0.96,
     1.04,
     0},
    {"wave",
     {{{11, 2, 16, 10}, {2, 12, 20, 12}, {-8, 22, 26, 14}, {-18, 34, 30, 16}}},
     48,
     12,
     10,
     4,
     1.08,
     0.94,
     16},
}};

struct FingerShape {
    const char* name;
    double x;
    double y;
    double length;
    double radius;
};

constexpr FingerShape kFingers[4] = {{"index", 0.315, 0.93, 0.86, 0.093},
                                     {"middle", 0.098, 0.985, 0.96, 0.096},
                                     {"ring", -0.118, 0.94, 0.88, 0.09},
                                     {"pinky", -0.315, 0.83, 0.68, 0.078}};

Figure hand_figure(Index member, bool cut)
{
    const Pose& pose = kPoses[member];
    const double w = pose.width;
    Figure figure;
    Solid& solid = figure.solid;
    const Frame palm;

    // The palm: a flat wedge, the bones of the middle hand, and the balls of thumb and little
    // finger.
    solid.sweep(
        {{{0.02, 0.1, 0}, 0.3 * w}, {{0.0, 0.55, 0}, 0.38 * w}, {{-0.01, 0.7, 0}, 0.34 * w}}, {},
        {palm, {1, 1, 0.42}});
    for (const FingerShape& finger : kFingers) {
        solid.sweep({{{0.45 * finger.x, 0.1, -0.02}, 0.11 * w},
                     {{finger.x * w, finger.y, -0.02}, 1.12 * finger.radius * w}},
                    {0.16, {finger.x * w, 0.6, 0}, 0.6});
    }
    solid.ellipsoid(palm.moved(0.24 * w, 0.34, 0.07).turned_z(-18), {0.15 * w, 0.27, 0.14 * w},
                    {0.12});
    solid.ellipsoid(palm.moved(-0.26 * w, 0.34, 0.06).turned_z(6), {0.11 * w, 0.3, 0.12 * w},
                    {0.12});

    // The wrist, bent against the palm.
    const Frame wrist = palm.moved(0.01, 0.05, -0.01).turned_x(pose.wrist_bend);
    const double arm = cut ? -0.85 : -0.62;
    solid.sweep({{wrist.point(0, 0.15, 0), 0.26 * w},
                 {wrist.point(0, -0.15, 0), 0.235 * w},
                 {wrist.point(0, -0.42, 0), 0.26 * w},
                 {wrist.point(0, arm, 0), 0.29 * w}},
                {0.15}, {wrist, {1, 1, 0.68}});

    // Fingers.
    std::array<Vec3, 5> knuckles;
    std::array<std::pair<Vec3, Vec3>, 5> tips;
    std::array<std::pair<Vec3, Vec3>, 5> joints;
    for (int i = 0; i < 4; ++i) {
        const FingerShape& shape = kFingers[i];
        const FingerPose& bend = pose.fingers[i];
        const double length = shape.length * pose.length;
        const double r = shape.radius * w;
        const Frame base = palm.moved(shape.x * w, shape.y, -0.01).turned_z(-bend.spread);
        const Frame first = base.turned_x(bend.base);
        const Frame second = first.moved(0, 0.46 * length, 0).turned_x(bend.middle);
        const Frame third = second.moved(0, 0.29 * length, 0).turned_x(bend.tip);
        const double end = 0.25 * length - 0.72 * r;
        solid.sweep({{base.point(0, -0.2, 0), 1.1 * r},
                     {first.origin, 1.08 * r},
                     {first.point(0, 0.23 * length, 0), 0.96 * r},
                     {second.origin, 0.98 * r},
                     {second.point(0, 0.15 * length, 0), 0.86 * r},
                     {third.origin, 0.86 * r},
                     {third.point(0, 0.6 * end, 0.04 * r), 0.8 * r},
                     {third.point(0, end, 0.02 * r), 0.7 * r}},
                    {0.09 * w, base.origin, 0.17});
        knuckles[i] = base.origin;
        tips[i] = {third.point(0, 0.5 * end, 0), third.y()};
        joints[i] = {second.origin, -second.z() - first.z()};
    }

    // The thumb turns in a plane of its own.
    {
        const double length = 0.98 * pose.length;
        const double r = 0.112 * w;
        const Frame base = palm.moved(0.27 * w, 0.24, 0.06)
                               .turned_z(-pose.thumb_out)
                               .turned_x(pose.thumb_in)
                               .turned_y(-50);
        const Frame first = base.moved(0, 0.42 * length, 0).turned_x(pose.thumb_middle);
        const Frame second = first.moved(0, 0.34 * length, 0).turned_x(pose.thumb_tip);
        const double end = 0.3 * length - 0.8 * r;
        solid.sweep({{base.origin, 1.35 * r},
                     {base.point(0, 0.2 * length, 0), 1.3 * r},
                     {first.origin, 1.05 * r},
                     {first.point(0, 0.17 * length, 0), 0.92 * r},
                     {second.origin, 0.98 * r},
                     {second.point(0, 0.6 * end, 0), 0.92 * r},
                     {second.point(0, end, 0), 0.72 * r}},
                    {0.2 * w, base.point(0, 0.1, 0), 0.34});
        knuckles[4] = first.origin;
        tips[4] = {second.point(0, 0.5 * end, 0), second.y()};
        joints[4] = {second.origin, -second.z() - first.z()};
    }

    const char* const names[5] = {"index", "middle", "ring", "pinky", "thumb"};
    for (const int i : {4, 0, 1, 2, 3}) {
        figure.landmark(std::string(names[i]) + "_tip", tips[i].first, tips[i].second);
    }
    for (const int i : {4, 0, 1, 2, 3}) {
        figure.landmark(std::string(names[i]) + "_joint", joints[i].first, joints[i].second);
    }
    for (const int i : {0, 1, 2, 3}) {
        figure.landmark(std::string(names[i]) + "_knuckle", knuckles[i], {0, 0, -1});
    }
    for (const int i : {0, 1, 2}) {
        const Vec3 between = 0.5 * (knuckles[i] + knuckles[i + 1]);
        const Vec3 along = knuckles[i] - knuckles[i + 1];
        const Vec3 forward = Vec3(-along.y(), along.x(), 0).normalized();
        figure.landmark(std::string(names[i]) + "_web", between - 0.2 * forward, forward);
    }
    figure.landmark("palm", {0, 0.55, 0}, {0, 0, 1});
    figure.landmark("back", {0, 0.5, 0}, {0, 0, -1});
    if (cut) {
        const Vec3 origin = wrist.point(0, -0.4, 0);
        figure.cut = CutPlane{origin, -wrist.y()};
        figure.landmark_on_rim("wrist_thumb_side", origin, wrist.x());
        figure.landmark_on_rim("wrist_palm_side", origin, wrist.z());
        figure.landmark_on_rim("wrist_pinky_side", origin, -wrist.x());
        figure.landmark_on_rim("wrist_back_side", origin, -wrist.z());
    } else {
        const Vec3 origin = wrist.point(0, -0.1, 0);
        figure.landmark("wrist_thumb_side", origin, wrist.x());
        figure.landmark("wrist_pinky_side", origin, -wrist.x());
        figure.landmark("arm_end", origin, -wrist.y());
    }
    figure.detail = 0.026;
    return figure;
}

ShapeClass hand_class(const char* name, const char* title, int boundary_loops,
                      Figure (*build)(Index))
{
    ShapeClass result{name, title, 0, boundary_loops, {}, build};
    for (const Pose& pose : kPoses) {
        result.members.emplace_back(pose.name);
    }
    return result;
}

}  // namespace

ShapeClass hands()
{
    return hand_class("hand", "Hands", 0, [](Index member) { return hand_figure(member, false); });
}

ShapeClass cut_hands()
{
    return hand_class("cut_hand", "Hands, cut at the wrist", 1,
                      [](Index member) { return hand_figure(member, true); });
}

}  // namespace layout_embedding::shapes
