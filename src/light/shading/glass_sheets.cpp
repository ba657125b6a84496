#include "light/shading/glass_sheets.h"

#include <algorithm>

namespace sunlit::light {

GlassSheets::GlassSheets(const Visibility& visibility)
    : vertices_(visibility.fixedGeometry(), visibility.movingGeometry()),
      visibility_(visibility),
      any_(visibility.hasGlass()),
      blends_(visibility.hasEvenBlends()) {}

void GlassSheets::veils(const Visibility::Sight& sight, std::vector<Hit>* hits) const {
  Visibility::Sight all = sight;
  all.backs = true;
  visibility_.veils(all, hits);
}

void GlassSheets::sheets(const Visibility::Sight& sight, std::vector<Hit>* hits) const {
  hits->clear();
  if (!any_) return;
  veils(sight, hits);
  hits->erase(std::remove_if(hits->begin(), hits->end(),
                             [this](const Hit& hit) { return !isGlass(vertices_.material(hit)); }),
              hits->end());
}

void GlassSheets::layers(const Visibility::Sight& sight, std::vector<Hit>* hits) const {
  hits->clear();
  if (!anyVeils()) return;
  visibility_.veils(sight, hits);
  hits->erase(std::remove_if(hits->begin(), hits->end(),
                             [this](const Hit& hit) {
                               return !isGlass(vertices_.material(hit)) && !visibility_.blendsEvenly(hit);
                             }),
              hits->end());
}

Eigen::Array3f GlassSheets::through(const Visibility::Sight& sight) const {
  Eigen::Array3f product = Eigen::Array3f::Ones();
  thread_local std::vector<Hit> hits;
  sheets(sight, &hits);
  for (const Hit& hit : hits) product *= straightThrough(at(hit, sight.direction.normalized()).reflection);
  return product;
}

Eigen::Array3f GlassSheets::throughVeils(const Visibility::Sight& sight) const {
  Eigen::Array3f product = Eigen::Array3f::Ones();
  if (!anyVeils()) return product;
  thread_local std::vector<Hit> hits;
  veils(sight, &hits);
  for (const Hit& hit : hits) {
    const scene::Material& material = vertices_.material(hit);
    if (isGlass(material)) {
      product *= straightThrough(at(hit, sight.direction.normalized()).reflection);
    } else if (visibility_.blendsEvenly(hit)) {
      product *= 1.0f - material.alpha;
    }
  }
  return product;
}

}  // namespace sunlit::light
