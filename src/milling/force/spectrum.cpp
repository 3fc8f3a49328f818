// SPDX-License-Identifier: MIT
// Harmonics of the force in closed form. Legend: m is the order (multiple of the spindle frequency). A piece
// of a tooth at lag l behind its tip is at phi = theta + phase - l. Therefore
//   F_m = 1/(2 pi) sum over pieces of  integral dz load(z) e^{-i m (l(z) - phase)}  *  integral dphi s(phi)
//   e^{-i m phi}
// where s is one of sin cos, sin^2, cos, sin, 1. These are sums of e^{i p phi}, |p| <= 2, whose integral over
// the window is (e^{i(p-m) exit} - e^{i(p-m) entry}) / (i (p-m)), and exit - entry for p = m.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>

#include "base/math.hpp"
#include "milling/force/force.hpp"
#include "milling/force/lanes.hpp"
#include "milling/force/profile_quadrature.hpp"

namespace tribo::milling {
namespace {

using contact::ForceHarmonic;

// A complex number whose product compiles to four multiplications (std::complex handles infinities).
struct Phasor {
    double re = 1, im = 0;
};
inline Phasor operator*(Phasor a, Phasor b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
inline Phasor operator+(Phasor a, Phasor b) {
    return {a.re + b.re, a.im + b.im};
}
inline Phasor operator-(Phasor a, Phasor b) {
    return {a.re - b.re, a.im - b.im};
}
inline Phasor operator*(double s, Phasor a) {
    return {s * a.re, s * a.im};
}
Phasor unit(double angle) {
    Phasor p;
    math::sincos(angle, p.im, p.re);
    return p;
}

// The powers e^{-i n step angle}, n = 0, 1, 2, ...: one product for each.
class Powers {
  public:
    Powers() = default;
    Powers(double angle, int step) : turn_(unit(-angle * step)) {}
    Phasor now;
    void advance() { now = now * turn_; }

  private:
    Phasor turn_;
};

// Integrals over the window of sin cos, sin^2, cos, sin and 1 times e^{-i m phi}.
struct WindowMoments {
    Phasor sin_cos, sin2, cos, sin, one;
};

class Window {
  public:
    Window(double entry, double exit, int step)
        : width_(exit - entry),
          entry_(unit(entry)),
          exit_(unit(exit)),
          at_entry_(entry, step),
          at_exit_(exit, step) {}

    WindowMoments moments(int m) const {
        const Phasor up = at_exit_.now, down = at_entry_.now;
        // Integrals of e^{i p phi}: e^{-i m phi} e^{i p phi} at both ends.
        const Phasor p0 = over(up - down, -m);
        const Phasor p1 = over(up * exit_ - down * entry_, 1 - m);
        const Phasor n1 = over(up * conjugate(exit_) - down * conjugate(entry_), -1 - m);
        const Phasor exit2 = exit_ * exit_, entry2 = entry_ * entry_;
        const Phasor p2 = over(up * exit2 - down * entry2, 2 - m);
        const Phasor n2 = over(up * conjugate(exit2) - down * conjugate(entry2), -2 - m);
        return {.sin_cos = 0.25 * minus_i(p2 - n2),
                .sin2 = 0.5 * p0 - 0.25 * (p2 + n2),
                .cos = 0.5 * (p1 + n1),
                .sin = 0.5 * minus_i(p1 - n1),
                .one = p0};
    }
    void advance() {
        at_entry_.advance();
        at_exit_.advance();
    }

  private:
    static Phasor conjugate(Phasor a) { return {a.re, -a.im}; }
    static Phasor minus_i(Phasor a) { return {a.im, -a.re}; }
    // difference / (i q); the width of the window for q = 0.
    Phasor over(Phasor difference, int q) const {
        return q == 0 ? Phasor{width_, 0} : (1.0 / q) * minus_i(difference);
    }

    double width_;
    Phasor entry_, exit_;
    Powers at_entry_, at_exit_;
};

void add(ForceHarmonic& out, Lanes re, Lanes im) {
    out.x += std::complex<double>(re[0], im[0]);
    out.y += std::complex<double>(re[1], im[1]);
    out.z += std::complex<double>(re[2], im[2]);
    out.torque += std::complex<double>(re[3], im[3]);
}

// On the cylinder the load is constant and the integral over the height is a sinc:
// integral e^{-i m l} dz = height e^{-i m middle} sin(m half) / (m half), half: half the lag from end to end.
void add_cylinder(const EngagedEdge& edge, double scale, int step, std::span<ForceHarmonic> out) {
    const TurnLaw &t = edge.load.t, &r = edge.load.r, &a = edge.load.a, &m = edge.load.m;
    // cos^2 is 1 - sin^2.
    const Lanes of_sin_cos{-t.sine - r.cosine, t.cosine - r.sine, 0, 0};
    const Lanes of_sin2{t.cosine - r.sine, t.sine + r.cosine, 0, 0};
    const Lanes of_cos{-t.constant, -r.constant, a.cosine, m.cosine};
    const Lanes of_sin{-r.constant, t.constant, a.sine, m.sine};
    const Lanes of_one{-t.cosine, -r.cosine, a.constant, m.constant};

    const double half = edge.straight() ? 0 : 0.5 * (edge.lag1_rad - edge.lag0_rad);
    const double weight = scale * edge.weight_mm;
    Powers lag(0.5 * (edge.lag0_rad + edge.lag1_rad) - edge.phase_rad, step), spread(-half, step);
    Window window(edge.entry_rad, edge.exit_rad, step);
    for (std::size_t n = 0; n < out.size(); ++n) {
        const int order = static_cast<int>(n) * step;
        const double sinc = order > 0 && half > 0 ? spread.now.im / (order * half) : 1;
        const Phasor height = (weight * sinc) * lag.now;
        const WindowMoments w = window.moments(order);
        const Phasor sin_cos = height * w.sin_cos, sin2 = height * w.sin2, cos = height * w.cos,
                     sin = height * w.sin, one = height * w.one;
        add(out[n],
            of_sin_cos * sin_cos.re + of_sin2 * sin2.re + of_cos * cos.re + of_sin * sin.re + of_one * one.re,
            of_sin_cos * sin_cos.im + of_sin2 * sin2.im + of_cos * cos.im + of_sin * sin.im +
                of_one * one.im);
        lag.advance();
        spread.advance();
        window.advance();
    }
}

// In the rounded part the integral over the height is Gauss-Legendre. The caller keeps the piece short enough
// for the highest harmonic.
void add_round(const EngagedEdges& tool, const EngagedEdge& edge, double z0, double z1, double scale,
               int step, std::span<ForceHarmonic> out) {
    struct Point {
        Lanes sine, cosine, constant;  // parts t, r, a, m of the load
        Powers lag;
    };
    Point points[6];
    int count = 0;
    const double phase = tool.lag_per_mm() * (z1 - z0) * step * static_cast<double>(out.size());
    visit_profile(
        tool, edge.chip, z0, z1, profile_rule(tool, z0, z1, phase), [&](double lag, const EdgeLoad& f) {
            points[count++] = {Lanes{f.t.sine, f.r.sine, f.a.sine, f.m.sine} * scale,
                               Lanes{f.t.cosine, f.r.cosine, f.a.cosine, f.m.cosine} * scale,
                               Lanes{f.t.constant, f.r.constant, f.a.constant, f.m.constant} * scale,
                               Powers(lag - edge.phase_rad, step)};
        });
    Window window(edge.entry_rad, edge.exit_rad, step);
    for (std::size_t n = 0; n < out.size(); ++n) {
        Lanes sine_re, sine_im, cosine_re, cosine_im, constant_re, constant_im;
        for (int i = 0; i < count; ++i) {
            Point& p = points[i];
            sine_re += p.sine * p.lag.now.re;
            sine_im += p.sine * p.lag.now.im;
            cosine_re += p.cosine * p.lag.now.re;
            cosine_im += p.cosine * p.lag.now.im;
            constant_re += p.constant * p.lag.now.re;
            constant_im += p.constant * p.lag.now.im;
            p.lag.advance();
        }
        const auto sine = [&](int i) { return Phasor{sine_re[i], sine_im[i]}; };
        const auto cosine = [&](int i) { return Phasor{cosine_re[i], cosine_im[i]}; };
        const auto constant = [&](int i) { return Phasor{constant_re[i], constant_im[i]}; };
        const WindowMoments w = window.moments(static_cast<int>(n) * step);
        const Phasor cos2 = w.one - w.sin2;
        const Phasor x = sine(0) * w.sin_cos + cosine(0) * cos2 + constant(0) * w.cos + sine(1) * w.sin2 +
                         cosine(1) * w.sin_cos + constant(1) * w.sin;
        const Phasor y = sine(0) * w.sin2 + cosine(0) * w.sin_cos + constant(0) * w.sin -
                         (sine(1) * w.sin_cos + cosine(1) * cos2 + constant(1) * w.cos);
        const Phasor z = sine(2) * w.sin + cosine(2) * w.cos + constant(2) * w.one;
        const Phasor torque = sine(3) * w.sin + cosine(3) * w.cos + constant(3) * w.one;
        add(out[n], Lanes{-x.re, y.re, z.re, torque.re}, Lanes{-x.im, y.im, z.im, torque.im});
        window.advance();
    }
}

// Widest turn of e^{-i m l} over one set of Gauss points.
constexpr double kPhasePerPanelRad = 4;
// Widest step of sin(kappa / 2) over one set of Gauss points.
constexpr double kProfilePerPanel = 0.36;

// A piece of a profile, in steps along it.
void add_profile(const EngagedEdges& tool, const EngagedEdge& edge, double scale, int step, double highest,
                 std::span<ForceHarmonic> out) {
    const CutterProfile::Part& part = tool.profile().parts()[static_cast<std::size_t>(edge.part)];
    const double s0 = part.at_height(edge.z0_mm), s1 = part.at_height(edge.z1_mm);
    const double turn = highest * (edge.lag1_rad - edge.lag0_rad);
    const double bow = profile_step(tool, edge.z0_mm, edge.z1_mm);
    const int panels = 1 + static_cast<int>(std::max(turn / kPhasePerPanelRad, bow / kProfilePerPanel));
    double from = edge.z0_mm;
    for (int i = 0; i < panels; ++i) {
        const double to = i + 1 == panels ? edge.z1_mm : part.at(s0 + (s1 - s0) * (i + 1) / panels).height_mm;
        add_round(tool, edge, from, to, scale, step, out);
        from = to;
    }
}

void add_pieces(const EngagedEdges& tool, int step, std::span<ForceHarmonic> out) {
    const double scale = (tool.uniform() ? tool.flutes() : 1) / math::kTwoPi;
    const double highest = step * static_cast<double>(out.size() - 1);
    for (const EngagedEdge& edge : tool.edges()) {
        if (!edge.round) {
            add_cylinder(edge, scale, step, out);
            continue;
        }
        if (edge.part >= 0) {
            add_profile(tool, edge, scale, step, highest, out);
            continue;
        }
        const double diameter = 2 * tool.corner_mm();
        const double u0 = std::sqrt(edge.z0_mm / diameter), u1 = std::sqrt(edge.z1_mm / diameter);
        const double turn = highest * (edge.lag1_rad - edge.lag0_rad);
        const int panels =
            1 + static_cast<int>(std::max(turn / kPhasePerPanelRad, (u1 - u0) / kProfilePerPanel));
        for (int i = 0; i < panels; ++i) {
            const double from = u0 + (u1 - u0) * i / panels, to = u0 + (u1 - u0) * (i + 1) / panels;
            add_round(tool, edge, diameter * from * from, diameter * to * to, scale, step, out);
        }
    }
}

}  // namespace

void force_spectrum(const EngagedEdges& tool, int tooth_harmonics, contact::ForceSpectrum& out) {
    assert(tooth_harmonics >= 0);
    out.order_step = tool.uniform() ? tool.flutes() : 1;
    out.harmonics.clear();
    if (tool.empty()) return;
    out.harmonics.resize(static_cast<std::size_t>(tooth_harmonics * tool.flutes() / out.order_step) + 1);
    add_pieces(tool, out.order_step, out.harmonics);
}

contact::ToolForce mean_force(const EngagedEdges& tool) {
    ForceHarmonic mean;
    add_pieces(tool, 1, {&mean, 1});
    return {{mean.x.real(), mean.y.real(), mean.z.real()}, mean.torque.real()};
}

}  // namespace tribo::milling
