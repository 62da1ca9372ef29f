#include "station/app/page-inl.hpp"

namespace yars::station {

void begin_page(Site& site, Upgrade upgrade, PlainStream stream, Counted counted, Request request) {
  open_page(site, std::move(upgrade), std::move(stream), std::move(counted), std::move(request));
}

}  // namespace yars::station
