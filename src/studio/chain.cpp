#include "sunlit/studio/chain.h"

namespace sunlit::studio {

std::vector<Field> fieldsOf(ChainOptions& chain) {
  return joined({under("shutter", fieldsOf(chain.shutter)), under("vignetting", fieldsOf(chain.vignetting)),
                 under("glare", fieldsOf(chain.glare)), under("blur", fieldsOf(chain.blur)),
                 under("exposure", fieldsOf(chain.exposure)), under("noise", fieldsOf(chain.noise)),
                 under("mosaic", fieldsOf(chain.mosaic))});
}

void validate(const ChainOptions& chain) {
  image::validate(chain.shutter);
  image::validate(chain.vignetting);
  image::validate(chain.glare);
  image::validate(chain.blur);
  image::validate(chain.exposure);
  image::validate(chain.noise);
}

}  // namespace sunlit::studio
