// Tests of open_source(), which makes a flight model from the option --source of flight-model.
#include "flightmodel/source_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

namespace yars::flightmodel {
namespace {

using ::testing::HasSubstr;

error::Error refusal_of(const std::string& text) {
  const auto source = open_source(text);
  return source ? error::Error{} : source.error();
}

TEST(FlightSource, AMisspelledKindIsAnsweredWithTheNearest) {
  EXPECT_THAT(open_source("rout:x.route").error().message(), ::testing::HasSubstr("did you mean 'route:'?"));
}

TEST(FlightSource, AFixedSourceOpens) {
  auto source = open_source("fixed:38,-123,15000,160,480");
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_STREQ(source->model->step({}).ownship.source, "fixed");
}

TEST(FlightSource, TheShippedRouteOpens) {
  auto source = open_source("route:" YARS_SOURCE_DIR "/config/routes/california.route");
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_STREQ(source->model->step({}).ownship.source, "route");
}

TEST(FlightSource, AnInvalidSourceIsBadUsage) {
  for (const auto* text : {"", "route:", "csv:", "fixed:", "fixed:1,2,3", "balloon:3", "route"}) {
    const auto error = refusal_of(text);
    EXPECT_TRUE(error.bad_usage()) << text;
    EXPECT_FALSE(error.expected.empty()) << text;
  }
}

TEST(FlightSource, ARefusalNamesTheExternalProgramsToo) {
  EXPECT_THAT(refusal_of("balloon:3").message(), HasSubstr("xplane:HOST:PORT"));
}

TEST(FlightSource, AMissingFileIsAnErrorButNotBadUsage) {
  const auto error = refusal_of("route:/nonexistent/x.route");
  EXPECT_FALSE(error.bad_usage());
  EXPECT_THAT(error.message(), HasSubstr("/nonexistent/x.route"));
}

}  // namespace
}  // namespace yars::flightmodel
