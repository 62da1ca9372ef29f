#include "model/reflectivity/texture.hpp"

#include <algorithm>
#include <cmath>

namespace yars::model::reflectivity {

namespace {
constexpr double kSmall = 1e-15;  // a term or a factor that changes nothing any more
constexpr int kMostTerms = 10000;

// By the power series; quick below the mean.
double lower_series(double shape, double x) {
  double term = 1.0 / shape;
  double sum = term;
  for (int n = 1; n < kMostTerms && term > sum * kSmall; ++n) {
    term *= x / (shape + n);
    sum += term;
  }
  return sum * std::exp(shape * std::log(x) - x - std::lgamma(shape));
}

// The upper one by the continued fraction x + 1 - a - 1(1 - a)/(x + 3 - a - 2(2 - a)/(...)), Lentz's method.
double upper_fraction(double shape, double x) {
  double b = x + 1.0 - shape;
  double d = 1.0 / b;
  double c = 1e300;
  double product = d;
  for (int n = 1; n < kMostTerms; ++n) {
    const double a = -n * (n - shape);
    b += 2.0;
    d = 1.0 / (a * d + b);
    c = b + a / c;
    product *= c * d;
    if (std::abs(c * d - 1.0) < kSmall) break;
  }
  return product * std::exp(shape * std::log(x) - x - std::lgamma(shape));
}

// Where P(shape, x) reaches a share, beyond `low`: Newton's steps by the density, halved into the bracket.
double quantile(double shape, double share, double low) {
  double high = std::max(2.0 * low, shape + 1.0);
  while (incomplete_gamma(shape, high) < share) high *= 2.0;
  double x = 0.5 * (low + high);
  for (int step = 0; step < 60 && high - low > 1e-9 * high; ++step) {
    const double excess = incomplete_gamma(shape, x) - share;
    (excess < 0.0 ? low : high) = x;
    if (std::abs(excess) < 1e-12) break;
    const double density = std::exp((shape - 1.0) * std::log(x) - x - std::lgamma(shape));
    const double next = x - excess / density;
    x = next > low && next < high ? next : 0.5 * (low + high);
  }
  return x;
}
}  // namespace

double incomplete_gamma(double shape, double x) {
  if (!(x > 0.0)) return 0.0;
  return x < shape + 1.0 ? lower_series(shape, x) : 1.0 - upper_fraction(shape, x);
}

TextureLevels make_texture_levels(double shape) {
  TextureLevels levels;
  levels.fill(1.0F);
  if (!(shape > 0.0)) return levels;
  // The mean over a share of the distribution is that of x p(x): a gamma distribution of the next shape.
  double below = 0.0;
  double edge = 0.0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const bool last = i + 1 == levels.size();
    const double share = static_cast<double>(i + 1) / static_cast<double>(levels.size());
    if (!last) edge = quantile(shape, share, edge);
    const double through = last ? 1.0 : incomplete_gamma(shape + 1.0, edge);
    levels[i] = static_cast<float>((through - below) * static_cast<double>(levels.size()));
    below = through;
  }
  return levels;
}

double texture_cell_m(double pulse_length_m, double spacing_m) {
  return std::exp2(std::ceil(std::log2(std::max({pulse_length_m, spacing_m, 1.0}))));
}

}  // namespace yars::model::reflectivity
