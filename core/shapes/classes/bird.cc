// Birds, looking along z. The body is about one unit long.

#include <array>

#include "shapes/classes/classes.hh"

namespace layout_embedding::shapes {

namespace {

struct Bird {
    const char* name;
    double body;
    double girth;
    /// Degrees by which the body's axis points up.
    double pitch;
    double neck;
    double neck_angle;
    double head;
    double beak;
    double beak_radius;
    double beak_drop;
    /// Wings: lengths of both bones, chord, degrees above the horizontal, at the wrist, and swept
    /// back.
    double arm;
    double hand;
    double chord;
    double lift;
    double bend;
    double sweep;
    double tail;
    double tail_width;
    double tail_angle;
    /// Legs: length, thickness, degrees forwards (big: tucked back).
    double leg;
    double leg_radius;
    double leg_swing;
};

const std::array<Bird, 9> kBirds{{
    {"pigeon", 1.0, 0.27, 10,  0.16, 50,   0.155, 0.13, 0.045, 8,    0.55,
     0.6,      0.3, 24,   -16, 14,   0.42, 0.2,   0,    0.3,   0.04, -10},
    {"gull", 1.05, 0.24, 4,   0.14, 34,   0.15, 0.2, 0.045, 10,    0.8,
     0.95,   0.22, 30,   -34, 20,   0.36, 0.16, 4,   0.24,  0.034, -40},
    {"eagle", 1.15, 0.28, 6,  0.12, 24,  0.16, 0.17, 0.06, 34,    0.85,
     0.8,     0.38, 12,   14, 4,    0.5, 0.26, 0,    0.24, 0.055, -20},
    {"heron", 0.95, 0.22, 22,  0.85, 62,   0.115, 0.5, 0.042, 2,     0.7,
     0.6,     0.3,  50,   -30, 10,   0.24, 0.12,  6,   0.9,   0.034, 0},
    {"duck", 1.1,  0.3, 0,   0.34, 66,   0.165, 0.2, 0.07, 6,     0.5,
     0.5,    0.24, 44,  -24, 16,   0.28, 0.15,  24,  0.14, 0.045, -6},
    {"swan", 1.3,  0.33, 4,   0.9, 78,   0.135, 0.2, 0.052, 12,   0.75,
     0.75,   0.34, 58,   -44, 14,  0.34, 0.17,  18,  0.2,   0.05, -20},
    {"swallow", 0.85, 0.19, 6,   0.08, 20,   0.13, 0.09, 0.036, 4,     0.4,
     0.95,      0.18, 20,   -18, 46,   0.62, 0.14, 0,    0.12,  0.032, -50},
    {"owl", 1.0, 0.33, 46,  0.1, 34,   0.25, 0.1, 0.05, 50,   0.55,
     0.55,  0.4, 18,   -30, 4,   0.34, 0.22, -30, 0.2,  0.06, 10},
    {"hummingbird", 0.75, 0.19, 40, 0.1, 20,   0.13, 0.42, 0.03, 4,     0.3,
     0.62,          0.2,  52,   6,  6,   0.36, 0.14, -20,  0.1,  0.032, -20},
}};

Figure bird_figure(Index member)
{
    const Bird& bird = kBirds[member];
    Figure figure;
    Solid& solid = figure.solid;
    const double half = 0.5 * bird.body;
    const double g = bird.girth;
    const Frame body = Frame{}.turned_x(-bird.pitch);
    solid.sweep({{body.point(0, 0.02, -half), 0.34 * g},
                 {body.point(0, 0.0, -0.45 * half), 0.8 * g},
                 {body.point(0, -0.02, 0.15 * half), g},
                 {body.point(0, 0.02, 0.6 * half), 0.82 * g}},
                {});

    // Neck: it leaves upwards and turns forwards. The head looks straight ahead.
    const Frame root = Frame{body.point(0, 0.06, 0.55 * half), Frame{}.axes};
    const double n = bird.neck;
    const double c = cosine(bird.neck_angle);
    const double s = sine(bird.neck_angle);
    const double nr = 0.62 * bird.head;
    const double from = 0.5 * g;
    const Vec3 middle = root.point(0, s * (from + 0.55 * n), c * (from + 0.3 * n));
    const Vec3 top =
        root.point(0, s * (from + n) + 0.3 * bird.head, c * (from + n) + 0.1 * bird.head);
    solid.sweep({{root.origin, 0.7 * g},
                 {middle, n > 0.5 ? 0.72 * bird.head : 0.9 * bird.head},
                 {top, n > 0.5 ? nr : 0.85 * bird.head}},
                {0.5 * g});
    const Frame head{top + Vec3(0, 0.1 * bird.head, 0.2 * bird.head), Frame{}.axes};
    const double r = bird.head;
    solid.ellipsoid(head, Vec3(0.92, 0.95, 1.08) * r, {0.5 * r});
    const Frame beak = head.moved(0, -0.16 * r, 0.8 * r).turned_x(0.4 * bird.beak_drop);
    const Frame hook = beak.moved(0, 0, 0.55 * bird.beak).turned_x(bird.beak_drop);
    solid.sweep({{beak.point(0, 0, -0.1), 1.9 * bird.beak_radius},
                 {hook.origin, 1.15 * bird.beak_radius},
                 {hook.point(0, 0, 0.45 * bird.beak + 0.05), 0.026}},
                {0.05});
    figure.landmark("beak_tip", hook.point(0, 0, 0.45 * bird.beak + 0.05), hook.z());
    figure.landmark("crown", head.origin, head.y());
    figure.landmark("throat", head.point(0, -0.2 * r, 0), head.direction(0, -0.8, 0.6));
    figure.landmark("breast", body.point(0, -0.02, 0.3 * half), body.direction(0, -0.5, 0.85));
    figure.landmark("back", body.point(0, 0, 0), body.y());
    figure.landmark("belly", body.point(0, 0, -0.1 * half), -body.y());

    // The tail: a fan.
    const Frame tail = body.moved(0, 0.04, -0.8 * half).turned_y(180).turned_x(-bird.tail_angle);
    const Squash fan{tail, {1, 0.3, 1}};
    const double spread = bird.tail_width;
    for (const double side : {-1.0, 0.0, 1.0}) {
        const double fork = side == 0.0 ? (bird.tail > 0.6 ? 0.45 : 0.96) : 1.0;
        solid.sweep({{tail.point(0, 0, -0.05), 0.14},
                     {tail.point(0.4 * spread * side, 0, 0.5 * fork * bird.tail), 0.14},
                     {tail.point(spread * side, 0, fork * bird.tail), 0.11}},
                    {0.06}, fan);
    }
    figure.landmark("tail_middle", tail.point(0, 0, 0.2 * bird.tail), tail.z());
    // The tail's frame looks back: its x is the bird's right.
    figure.landmark("left_tail", tail.point(-spread, 0, bird.tail), tail.direction(-0.5, 0, 0.85));
    figure.landmark("right_tail", tail.point(spread, 0, bird.tail), tail.direction(0.5, 0, 0.85));

    for (const double side : {1.0, -1.0}) {
        const Frame eye = head.moved(0.74 * r * side, 0.22 * r, 0.42 * r);
        solid.ellipsoid(eye, Vec3::Constant(0.24 * r), {0.03});
        figure.landmark(side_name(side, "eye"), eye.origin, eye.direction(side, 0.1, 0.3));

        // Wings: a tapering arm in front, feathers behind it, all in one plane per bone.
        const Frame joint = body.moved(0.55 * g * side, 0.42 * g, 0.42 * half)
                                .turned_z(side * bird.lift)
                                .turned_y(side * 0.3 * bird.sweep);
        const Frame wrist = joint.moved(bird.arm * side, 0, 0)
                                .turned_z(side * bird.bend)
                                .turned_y(side * bird.sweep);
        const double ch = bird.chord;
        const Squash inner{joint, {1, 0.3, 1}};
        const Squash outer{wrist, {1, 0.3, 1}};
        const Vec3 tip = wrist.point(bird.hand * side, 0, -0.35 * ch);
        solid.sweep({{joint.point(-0.1 * side, 0, 0), 0.16},
                     {joint.point(0.5 * bird.arm * side, 0, 0.02), 0.15},
                     {wrist.origin, 0.13}},
                    {0.1, joint.origin, 0.25}, inner);
        solid.sweep({{joint.point(0.0, 0, -0.45 * ch), 0.45 * ch},
                     {joint.point(0.5 * bird.arm * side, 0, -0.5 * ch), 0.48 * ch},
                     {wrist.point(0, 0, -0.45 * ch), 0.42 * ch}},
                    {0.08}, {joint, {1, 0.04 / (0.45 * ch), 1}});
        solid.sweep({{wrist.origin, 0.13},
                     {wrist.point(0.55 * bird.hand * side, 0, -0.05 * ch), 0.11},
                     {tip, 0.09}},
                    {0.06}, outer);
        solid.sweep({{wrist.point(0, 0, -0.45 * ch), 0.42 * ch},
                     {wrist.point(0.55 * bird.hand * side, 0, -0.4 * ch), 0.33 * ch},
                     {tip, 0.12 * ch + 0.03}},
                    {0.1}, {wrist, {1, 0.038 / (0.42 * ch), 1}});
        figure.landmark(side_name(side, "wing_root"), joint.point(0.3 * bird.arm * side, 0, 0),
                        joint.y());
        figure.landmark(side_name(side, "wing_wrist"), wrist.origin, wrist.direction(0, 0, 1));
        figure.landmark(side_name(side, "wing_tip"), tip, wrist.direction(side, 0, -0.3));
        figure.landmark(side_name(side, "wing_rear"), wrist.point(0, 0, -0.45 * ch),
                        -wrist.z() - joint.z());

        // Legs and feet with three toes.
        const Frame hip =
            Frame{body.point(0.46 * g * side, -0.5 * g, -0.12 * half), Frame{}.axes}.turned_x(
                -bird.leg_swing);
        const double t = bird.leg_radius;
        const double length = 0.35 * g + bird.leg;
        const Frame knee = hip.moved(0, -0.5 * length, -0.12 * length).turned_x(-16);
        const Frame foot =
            Frame{knee.point(0, -0.5 * length, 0), Frame{}.axes}.turned_x(-0.7 * bird.leg_swing);
        solid.sweep({{hip.origin, 2.2 * t}, {knee.origin, 1.15 * t}, {foot.origin, t}},
                    {0.09, hip.origin, 0.2});
        for (const double toe : {-16.0, 14.0, 44.0}) {
            const Frame direction = foot.turned_y(side * toe);
            solid.sweep({{foot.origin, t}, {direction.point(0, -0.4 * t, 0.17), 0.72 * t}}, {0.03});
        }
        figure.landmark(side_name(side, "knee"), knee.origin, -knee.z());
        figure.landmark(side_name(side, "foot"), foot.turned_y(14 * side).point(0, -0.4 * t, 0.16),
                        foot.turned_y(14 * side).z());
    }
    figure.detail = 0.019;
    return figure;
}

}  // namespace

ShapeClass birds()
{
    ShapeClass result{"bird", "Birds", 0, 0, {}, bird_figure};
    for (const Bird& bird : kBirds) {
        result.members.emplace_back(bird.name);
    }
    return result;
}

}  // namespace layout_embedding::shapes
