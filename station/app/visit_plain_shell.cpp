#include "station/app/visit-inl.hpp"

namespace yars::station {

void begin_visit(Site& site, PlainStream stream) {
  std::make_shared<Visit<PlainStream>>(site, std::move(stream))->begin();
}

}  // namespace yars::station
