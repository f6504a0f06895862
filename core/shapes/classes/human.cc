// People, standing along y and looking along z, about 1.8 units tall.

#include <array>

#include "shapes/classes/classes.hh"

namespace layout_embedding::shapes {

namespace {

/// Angles in degrees.
struct ArmPose {
    /// Of the upper arm: sideways from hanging down, and forwards.
    double raise;
    double swing;
    double elbow;
    /// Turns the forearm's bend: 0 forwards, 90 inwards.
    double roll;
};

struct LegPose {
    double spread;
    double swing;
    double knee;
};

struct Person {
    const char* name;
    ArmPose left_arm;
    ArmPose right_arm;
    LegPose left_leg;
    LegPose right_leg;
    double lean;
    double head_turn;
    double head_nod;
    /// Proportions, 1 for the average.
    double height;
    double bulk;
    double shoulders;
    double hips;
    double belly;
    double head;
    double limbs;
    bool bust = false;
};

const std::array<Person, 10> kPeople{{
    {"standing",
     {14, 4, 14, 20},
     {14, 4, 14, 20},
     {5, 0, 4},
     {5, 0, 4},
     0,
     0,
     0,
     1,
     1,
     1,
     1,
     0,
     1,
     1},
    {"t_pose",
     {88, 0, 6, 0},
     {88, 0, 6, 0},
     {9, 0, 2},
     {9, 0, 2},
     0,
     0,
     0,
     1.03,
     1.02,
     1.05,
     0.97,
     0,
     0.97,
     1},
    {"walking",
     {17, 32, 30, 0},
     {17, -28, 18, 0},
     {4, -24, 14},
     {4, 24, 8},
     4,
     6,
     0,
     1,
     0.95,
     1,
     1,
     0,
     1,
     1.02},
    {"running",
     {16, 52, 84, 14},
     {20, -46, 88, 8},
     {4, -34, 62},
     {4, 58, 66},
     16,
     0,
     -12,
     1.02,
     0.94,
     1,
     0.95,
     0,
     0.98,
     1.04},
    {"woman",
     {16, 2, 16, 30},
     {48, 10, 96, 165},
     {5, 4, 6},
     {7, -4, 4},
     0,
     -14,
     4,
     0.95,
     0.86,
     0.88,
     1.06,
     0,
     1.02,
     1,
     true},
    {"child",
     {26, 12, 20, 10},
     {120, 4, 18, 10},
     {7, 0, 5},
     {7, 3, 5},
     0,
     16,
     6,
     0.72,
     1.12,
     0.9,
     1,
     0.25,
     1.42,
     0.84},
    {"stout",
     {24, 2, 20, 20},
     {24, 2, 20, 20},
     {8, 0, 4},
     {8, 0, 4},
     -2,
     0,
     0,
     0.97,
     1.28,
     1.06,
     1.16,
     1,
     1,
     0.94},
    {"cheering",
     {148, 6, 20, 0},
     {152, 10, 16, 0},
     {14, 2, 4},
     {14, -2, 4},
     -4,
     0,
     -10,
     1,
     0.97,
     1,
     1,
     0,
     1,
     1},
    {"sitting",
     {20, 34, 52, 20},
     {20, 34, 52, 20},
     {9, 84, 86},
     {9, 84, 86},
     4,
     10,
     6,
     1,
     1,
     1,
     1,
     0.2,
     1,
     1},
    {"dancing",
     {100, 0, 50, -40},
     {58, -20, 36, 30},
     {6, -6, 4},
     {30, 36, 96},
     -6,
     -20,
     -6,
     1.02,
     0.85,
     0.9,
     1,
     0,
     1,
     1.08,
     true},
}};

Figure person_figure(Index member)
{
    const Person& person = kPeople[member];
    Figure figure;
    Solid& solid = figure.solid;
    const double h = person.height;
    const double b = person.bulk * h;
    const double limb = person.limbs * h;
    const double shoulder_x = 0.175 * person.shoulders * h;
    const double hip_x = 0.09 * person.hips * h;

    const Frame pelvis{{0, 0.92 * limb + 0.02 * h, 0}, Frame{}.axes};
    const Frame spine = pelvis.turned_x(person.lean);
    const Squash flat{spine, {1, 1, 0.7}};
    const double hips = 0.148 * person.hips * b;
    const double chest = 0.15 * person.shoulders * b;
    solid.sweep({{spine.point(0, -0.01 * h, 0), hips}, {spine.point(0, 0.03 * h, 0), hips}}, {},
                flat);
    solid.sweep({{spine.point(0, 0.05 * h, 0), 0.11 * b},
                 {spine.point(0, 0.2 * h, 0), (0.108 + 0.05 * person.belly) * b},
                 {spine.point(0, 0.3 * h, 0), 0.12 * b}},
                {0.16 * b}, flat);
    solid.sweep({{spine.point(0, 0.33 * h, 0.005 * h), chest},
                 {spine.point(0, 0.38 * h, 0.0), 0.98 * chest},
                 {spine.point(0, 0.44 * h, -0.005 * h), 0.12 * person.shoulders * b},
                 {spine.point(0, 0.49 * h, -0.01 * h), 0.07 * b}},
                {0.14 * b}, flat);
    if (person.belly > 0.0) {
        solid.ellipsoid(spine.moved(0, 0.14 * h, 0.06 * b),
                        Vec3(0.13, 0.14, 0.06 + 0.09 * person.belly) * b, {0.12 * b});
    }
    if (person.bust) {
        for (const double side : {-1.0, 1.0}) {
            solid.ellipsoid(spine.moved(0.062 * b * side, 0.335 * h, 0.085 * b),
                            Vec3(0.058, 0.056, 0.05) * b, {0.05 * b});
        }
    }
    for (const double side : {-1.0, 1.0}) {
        // Shoulders, chest muscles and the seat.
        solid.sweep({{spine.point(0.03 * h * side, 0.46 * h, -0.01 * h), 0.055 * b},
                     {spine.point(shoulder_x * side, 0.425 * h, -0.01 * h), 0.06 * b}},
                    {0.09 * h});
        solid.ellipsoid(spine.moved(0.072 * b * side, -0.03 * h, -0.055 * b),
                        Vec3(0.085, 0.095, 0.075) * b, {0.05 * h});
    }

    // Neck and head.
    const Frame neck = spine.moved(0, 0.49 * h, -0.012 * h).turned_x(0.5 * person.head_nod);
    solid.sweep(
        {{neck.point(0, -0.02 * h, 0), 0.06 * b}, {neck.point(0, 0.1 * h, 0.02 * h), 0.05 * b}},
        {0.07 * h});
    const double s = 0.5 * (h + 0.95) * person.head;
    const Frame head = neck.moved(0, 0.085 * h + 0.105 * s, 0.022 * h)
                           .turned_y(person.head_turn)
                           .turned_x(0.5 * person.head_nod);
    solid.ellipsoid(head.moved(0, 0.022 * s, -0.012 * s), Vec3(0.08, 0.094, 0.098) * s, {0.03 * h});
    solid.ellipsoid(head.moved(0, -0.045 * s, 0.028 * s), Vec3(0.061, 0.074, 0.066) * s,
                    {0.05 * s});
    solid.sweep({{head.point(0, 0.012 * s, 0.082 * s), 0.011 * s},
                 {head.point(0, -0.024 * s, 0.1 * s), 0.016 * s}},
                {0.025 * s});
    for (const double side : {-1.0, 1.0}) {
        solid.ellipsoid(head.moved(0.08 * s * side, -0.004 * s, -0.012 * s).turned_y(-20 * side),
                        Vec3(0.013, 0.034, 0.022) * s, {0.012 * s});
    }

    figure.landmark("head_top", head.origin, head.y());
    figure.landmark("nose", head.point(0, -0.024 * s, 0.09 * s), head.z());
    figure.landmark("chin", head.point(0, -0.07 * s, 0.03 * s), head.direction(0, -0.75, 0.65));
    figure.landmark("neck_back", neck.point(0, 0.05 * h, 0.01 * h), -neck.z());
    figure.landmark("chest", spine.point(0, 0.37 * h, 0), spine.z());
    figure.landmark("navel", spine.point(0, 0.13 * h, 0), spine.z());
    figure.landmark("upper_back", spine.point(0, 0.36 * h, 0), -spine.z());
    figure.landmark("lower_back", spine.point(0, 0.12 * h, 0), -spine.z());
    figure.landmark("crotch", pelvis.point(0, -0.02 * h, 0), -pelvis.y());

    for (const double side : {1.0, -1.0}) {
        const ArmPose& arm = side > 0.0 ? person.left_arm : person.right_arm;
        const LegPose& leg = side > 0.0 ? person.left_leg : person.right_leg;
        figure.landmark(side_name(side, "ear"), head.point(0.07 * s * side, 0, -0.01 * s),
                        side * head.x());

        // Bones run along -y of their frames.
        const Frame shoulder = spine.moved(shoulder_x * side, 0.42 * h, -0.01 * h)
                                   .turned_x(-arm.swing)
                                   .turned_z(side * arm.raise)
                                   .turned_y(-side * arm.roll);
        const double a = limb * 0.98;
        const Frame elbow = shoulder.moved(0, -0.285 * a, 0).turned_x(-arm.elbow);
        const Frame wrist = elbow.moved(0, -0.25 * a, 0).turned_x(6);
        solid.sweep({{shoulder.origin, 0.058 * b},
                     {shoulder.point(0, -0.1 * a, 0), 0.05 * b},
                     {shoulder.point(0, -0.2 * a, 0), 0.044 * b},
                     {elbow.origin, 0.037 * b},
                     {elbow.point(0, -0.08 * a, 0), 0.04 * b},
                     {elbow.point(0, -0.18 * a, 0), 0.031 * b},
                     {wrist.origin, 0.025 * b}},
                    {0.075 * b, shoulder.origin, 0.11 * b});
        solid.sweep({{wrist.point(0, 0.01 * a, 0), 0.028 * b},
                     {wrist.point(0, -0.06 * a, 0), 0.043 * b},
                     {wrist.point(0, -0.11 * a, 0), 0.04 * b},
                     {wrist.point(0, -0.16 * a, 0.01), 0.026 * b}},
                    {0.02 * b}, {wrist, {0.62, 1, 1}});
        solid.sweep({{wrist.point(0, -0.025 * a, 0.01 * b), 0.02 * b},
                     {wrist.point(0, -0.07 * a, 0.062 * b), 0.018 * b},
                     {wrist.point(0, -0.098 * a, 0.078 * b), 0.014 * b}},
                    {0.02 * b, wrist.point(0, -0.03 * a, 0.02 * b), 0.04 * b});
        figure.landmark(side_name(side, "shoulder"), shoulder.point(0, 0, 0),
                        spine.direction(0.75 * side, 0.65, 0));
        figure.landmark(side_name(side, "elbow"), elbow.point(0, 0.005 * h, 0),
                        -elbow.z() - shoulder.z());
        figure.landmark(side_name(side, "wrist"), wrist.origin, -wrist.z());
        figure.landmark(side_name(side, "hand"), wrist.point(0, -0.12 * a, 0), -wrist.y());
        figure.landmark(side_name(side, "thumb"), wrist.point(0, -0.092 * a, 0.074 * b),
                        wrist.direction(0, -0.7, 0.5));

        const Frame hip = pelvis.moved(hip_x * side, -0.02 * h, 0)
                              .turned_z(side * leg.spread)
                              .turned_x(-leg.swing);
        const Frame knee = hip.moved(0, -0.44 * limb, 0).turned_x(leg.knee);
        const Frame ankle =
            knee.moved(0, -0.4 * limb, 0).turned_x(-0.25 * leg.knee).turned_y(side * 8);
        solid.sweep({{hip.point(0, 0.02 * h, 0), 0.088 * b},
                     {hip.point(0, -0.1 * limb, 0), 0.083 * b},
                     {hip.point(0, -0.26 * limb, 0), 0.067 * b},
                     {knee.origin, 0.05 * b},
                     {knee.point(0, -0.1 * limb, -0.012 * b), 0.054 * b},
                     {knee.point(0, -0.26 * limb, -0.006 * b), 0.039 * b},
                     {ankle.origin, 0.032 * b}},
                    {0.07 * b, hip.point(0, 0.02 * h, 0), 0.1 * b});
        solid.sweep({{ankle.point(0, -0.03 * limb, -0.03 * h), 0.035 * b},
                     {ankle.point(0, -0.035 * limb, 0.05 * h), 0.034 * b},
                     {ankle.point(0, -0.045 * limb, 0.12 * h), 0.036 * b},
                     {ankle.point(0, -0.05 * limb, 0.16 * h), 0.024 * b}},
                    {0.04 * b}, {ankle, {1.1, 0.8, 1}});
        figure.landmark(side_name(side, "hip"), hip.point(0, 0.0, 0),
                        spine.direction(side, 0.1, 0));
        figure.landmark(side_name(side, "knee"), knee.origin, knee.z() + hip.z());
        figure.landmark(side_name(side, "heel"), ankle.point(0, -0.03 * limb, -0.03 * h),
                        -ankle.z());
        figure.landmark(side_name(side, "toe"), ankle.point(0, -0.05 * limb, 0.15 * h), ankle.z());
    }
    figure.detail = 0.0135 * h;
    return figure;
}

}  // namespace

ShapeClass people()
{
    ShapeClass result{"human", "People", 0, 0, {}, person_figure};
    for (const Person& person : kPeople) {
        result.members.emplace_back(person.name);
    }
    return result;
}

}  // namespace layout_embedding::shapes
