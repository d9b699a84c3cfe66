#pragma once

namespace hogel {

/// A corner of a triangle, with its signed height above the plane that cuts it.
struct Corner {
    double x, z, height;
};

/// Where an edge meets the plane, and the weight there of its first corner (the second has the rest).
struct Cut {
    double x, z, weight;
};

/// Cuts an edge whose corners lie on different sides: one height is below 0, the other is not. Always computed from the
/// lower corner to the upper, so that the triangles that share the edge get the same point, to the last bit.
inline Cut cut(const Corner& a, const Corner& b) {
    const bool upwards = a.height < 0;
    const Corner &low = upwards ? a : b, &high = upwards ? b : a;
    const double part = low.height / (low.height - high.height);
    return {low.x + part * (high.x - low.x), low.z + part * (high.z - low.z), upwards ? 1 - part : part};
}

}  // namespace hogel
