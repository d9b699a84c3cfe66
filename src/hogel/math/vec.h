#pragma once

#include <cmath>

namespace hogel {

/// A point or a direction in the frame of docs/notation.md: x right, y up, z towards the viewer; metres.
struct Vec3 {
    double x = 0, y = 0, z = 0;

    friend Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
    friend Vec3 operator*(double k, Vec3 a) { return {k * a.x, k * a.y, k * a.z}; }
    friend Vec3 operator*(Vec3 a, double k) { return k * a; }
    friend Vec3 operator/(Vec3 a, double k) { return {a.x / k, a.y / k, a.z / k}; }
    Vec3& operator+=(Vec3 b) { return *this = *this + b; }
    friend bool operator==(const Vec3&, const Vec3&) = default;
};

inline double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double length(Vec3 a) { return std::sqrt(dot(a, a)); }
inline Vec3 normalize(Vec3 a) { return a / length(a); }

/// A linear colour or any other RGB triple.
struct Rgb {
    float r = 0, g = 0, b = 0;

    friend Rgb operator+(Rgb a, Rgb c) { return {a.r + c.r, a.g + c.g, a.b + c.b}; }
    friend Rgb operator*(Rgb a, Rgb c) { return {a.r * c.r, a.g * c.g, a.b * c.b}; }
    friend Rgb operator*(float k, Rgb a) { return {k * a.r, k * a.g, k * a.b}; }
    Rgb& operator+=(Rgb c) { return *this = *this + c; }
    friend bool operator==(const Rgb&, const Rgb&) = default;
};

}  // namespace hogel
