#include "station/app/visit-inl.hpp"

namespace yars::station {

void begin_visit(Site& site, TlsStream stream) {
  std::make_shared<Visit<TlsStream>>(site, std::move(stream))->begin();
}

}  // namespace yars::station
