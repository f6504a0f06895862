// Aeroplanes, flying along z. The fuselage is about two units long.

#include <array>

#include "shapes/classes/classes.hh"

namespace layout_embedding::shapes {

namespace {

struct Plane {
    const char* name;
    double length;
    double radius;
    double nose;
    /// Wings: half span, chord at root and tip, degrees swept back and up, height on the fuselage,
    /// place along it.
    double span;
    double root;
    double tip;
    double sweep;
    double dihedral;
    double height;
    double place;
    double tail_span;
    double fin;
    /// Of the tail planes on the fin: 0 at the fuselage, 1 on top (T-tail).
    double tee;
    /// Engines: radius, place along the span; 0 at the fuselage's rear.
    double engine;
    double engine_place;
};

const std::array<Plane, 9> kPlanes{{
    {"airliner", 2.4, 0.15, 1.0, 1.15, 0.42, 0.15, 28, 5, -0.4, 0.1, 0.46, 0.42, 0.0, 0.085, 0.38},
    {"glider", 1.7, 0.11, 0.9, 1.75, 0.22, 0.13, 2, 4, 0.3, 0.16, 0.36, 0.3, 1.0, 0.05, 0.3},
    {"jet", 2.2, 0.14, 2.2, 0.7, 0.72, 0.18, 44, -2, 0.0, -0.12, 0.4, 0.4, 0.0, 0.07, 0.3},
    {"propeller", 1.6, 0.17, 0.5, 1.1, 0.36, 0.26, 0, 6, 0.8, 0.2, 0.44, 0.36, 0.0, 0.06, 0.34},
    {"business_jet", 2.0, 0.14, 1.4, 0.95, 0.36, 0.14, 22, 4, -0.5, 0.0, 0.4, 0.42, 1.0, 0.08, 0.0},
    {"cargo", 2.1, 0.23, 0.7, 1.25, 0.44, 0.2, 14, -3, 0.85, 0.1, 0.5, 0.5, 1.0, 0.1, 0.42},
    {"delta", 2.3, 0.125, 2.4, 0.72, 1.0, 0.15, 52, 0, -0.2, -0.2, 0.26, 0.42, 0.0, 0.07, 0.4},
    {"toy", 1.3, 0.24, 0.6, 0.85, 0.42, 0.34, 4, 5, -0.3, 0.1, 0.42, 0.38, 0.0, 0.09, 0.45},
    {"swept_forward", 2.0, 0.14, 1.6, 0.95, 0.42, 0.2, -24, 2, 0.0, -0.16, 0.36, 0.4, 0.0, 0.065,
     0.0},
}};

/// A flat tapering surface between two stations in the x-z plane of the frame, as two tubes so that
/// its chord does not shrink to a circle.
void add_surface(Solid& solid, const Frame& frame, double span, double root, double tip,
                 double sweep, double thickness, double blend)
{
    const double back = span * sine(sweep) / cosine(sweep);
    const double flatness = thickness / (0.2 * root);
    const double end = std::max(0.3 * tip, 0.022 / flatness);
    for (const double part : {-1.0, 0.0, 1.0}) {
        solid.sweep({{frame.point(0, 0, part * (0.5 * root - 0.17 * root)), 0.2 * root},
                     {frame.point(span, 0, -back + part * 0.25 * tip), end}},
                    {blend}, {frame, {1, flatness, 1}});
    }
}

Figure plane_figure(Index member)
{
    const Plane& plane = kPlanes[member];
    Figure figure;
    Solid& solid = figure.solid;
    const Frame body;
    const double half = 0.5 * plane.length;
    const double r = plane.radius;
    solid.sweep({{body.point(0, 0.35 * r, -half), 0.3 * r},
                 {body.point(0, 0.2 * r, -0.7 * half), 0.66 * r},
                 {body.point(0, 0, -0.25 * half), r},
                 {body.point(0, 0, 0.55 * half), r},
                 {body.point(0, -0.05 * r, half - plane.nose * r), 0.85 * r},
                 {body.point(0, -0.2 * r, half), 0.3 * r}},
                {});
    solid.ellipsoid(body.moved(0, 0.72 * r, 0.5 * half), {0.55 * r, 0.5 * r, 1.3 * r}, {0.4 * r});
    figure.landmark("nose", body.point(0, -0.2 * r, half), body.z());
    figure.landmark("tail_end", body.point(0, 0.35 * r, -half), -body.z());
    figure.landmark("cockpit", body.point(0, 0.5 * r, 0.5 * half), body.y());
    figure.landmark("roof", body.point(0, 0, -0.35 * half), body.y());
    figure.landmark("belly", body.point(0, 0, 0.1 * half), -body.y());

    // The fin stands on the tail: the frame's x is up.
    const Frame fin = body.moved(0, 0.2 * r, -0.8 * half).turned_z(90);
    const double fin_chord = 0.38;
    const double fin_height = plane.fin + 0.3 * r;
    add_surface(solid, fin, fin_height, fin_chord, 0.2, 34, 0.034, 0.06);
    const double fin_back = fin_height * sine(34) / cosine(34);
    figure.landmark("fin_tip", fin.point(fin_height, 0, -fin_back), fin.x());

    for (const double side : {1.0, -1.0}) {
        // Mirrored by a half turn: x to the right, and y down.
        Frame wing = body.moved(0, plane.height * r, plane.place * half);
        wing = side > 0.0 ? wing : wing.turned_z(180);
        wing = wing.turned_z(side * plane.dihedral);
        add_surface(solid, wing, plane.span, plane.root, plane.tip, plane.sweep, 0.04, 0.1);
        const double slope = sine(plane.sweep) / cosine(plane.sweep);
        const auto along = [&](double t, double chord) {
            const double c = plane.root + t * (plane.tip - plane.root);
            return wing.point(t * plane.span, 0, -t * plane.span * slope + chord * c);
        };
        figure.landmark(side_name(side, "wing_tip"), along(0.99, 0), wing.x());
        figure.landmark(side_name(side, "wing_front"), along(0.5, 0), wing.z());
        figure.landmark(side_name(side, "wing_rear"), along(0.5, 0), -wing.z());
        figure.landmark(side_name(side, "wing_top"), along(0.62, 0), side * wing.y());

        const Vec3 place = plane.tee > 0.5 ? fin.point(fin_height - 0.02, 0, -fin_back)
                                           : body.point(0, 0.3 * r, -0.86 * half);
        Frame tail{place, body.axes};
        tail = side > 0.0 ? tail : tail.turned_z(180);
        add_surface(solid, tail, plane.tail_span, 0.26, 0.15, 24, 0.032, 0.05);
        const double tail_back = plane.tail_span * sine(24) / cosine(24);
        figure.landmark(side_name(side, "tail_tip"), tail.point(plane.tail_span, 0, -tail_back),
                        tail.x());

        // Engines hang in front of and below the wing, or sit at the rear.
        const double e = plane.engine;
        const Vec3 mount = plane.engine_place > 0.0
                               ? Vec3(along(plane.engine_place, 0.42) - Vec3(0, 0.75 * e, 0))
                               : body.point(side * (0.78 * r + 0.75 * e), 0.4 * r, -0.42 * half);
        const Frame engine{mount, body.axes};
        solid.sweep({{engine.point(0, 0, -1.6 * e), 0.6 * e},
                     {engine.point(0, 0, -0.4 * e), e},
                     {engine.point(0, 0, 1.0 * e), 0.95 * e}},
                    {0.04});
        figure.landmark(side_name(side, "engine_front"), engine.point(0, 0, e), engine.z());
        figure.landmark(side_name(side, "engine_rear"), engine.point(0, 0, -1.6 * e), -engine.z());
    }
    figure.detail = 0.02;
    return figure;
}

}  // namespace

ShapeClass planes()
{
    ShapeClass result{"plane", "Aeroplanes", 0, 0, {}, plane_figure};
    for (const Plane& plane : kPlanes) {
        result.members.emplace_back(plane.name);
    }
    return result;
}

}  // namespace layout_embedding::shapes
