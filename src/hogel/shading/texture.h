#pragma once

#include <memory>
#include <vector>

#include "hogel/scene.h"

namespace hogel {

/// A picture on a surface, repeated in both directions, with coarser versions of itself to be seen from afar.
class Texture {
  public:
    /// Point sampled unless `filtered`: then levels of half the size, each the mean of the one before, down to a single
    /// texel, are made (a third more memory).
    Texture(std::shared_ptr<const Image> finest, bool filtered = false);

    /// The picture interpolated between texels, averaged over about `width` texels of the finest level.
    Rgb sample(TextureCoordinate at, double width) const;
    /// Texels of the finest level in the unit square of texture coordinates.
    double texels() const { return static_cast<double>(finest_->width()) * static_cast<double>(finest_->height()); }
    bool filtered() const { return !coarser_.empty(); }

  private:
    std::shared_ptr<const Image> finest_;
    std::vector<Image> coarser_;
};

}  // namespace hogel
