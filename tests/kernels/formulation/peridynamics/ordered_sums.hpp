// The interactions of the theory page written as they are printed: ordered sums over all points, nothing
// collapsed, nothing shared, no neighbour list.
#pragma once

#include "formulation/peridynamics/clouds.hpp"

namespace cleave::test {

class OrderedSums {
 public:
  OrderedSums(const Cloud& cloud, double horizon, const Model& model)
      : cloud_(cloud), horizon_(horizon), n_(cloud.size()), intact_(n_ * n_, 1) {
    const auto ends = model.integer("bond_ends"), status = model.integer("bond_status");
    for (std::size_t b = 0; b < status.size(); ++b) {
      const auto i = static_cast<std::size_t>(ends[2 * b]),
                 p = static_cast<std::size_t>(ends[2 * b + 1]);
      if (status[b] != 0) intact_[i * n_ + p] = intact_[p * n_ + i] = 0;
    }
    for (std::size_t i = 0; i < n_; ++i) x_.push_back(cloud.X[i]);
    const auto u = model.real("displacement");
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t k = 0; k < 3; ++k) x_[i][k] += u[3 * i + k];
  }

  // V_H: own volume and those of all neighbours.
  double hood(std::size_t i) const {
    double sum = cloud_.volume[i];
    for (std::size_t j = 0; j < n_; ++j) sum += near(i, j) ? cloud_.volume[j] : 0.0;
    return sum;
  }

  // (14)
  std::vector<double> one(double C1) const {
    return forces([&](std::size_t i, Point& b) {
      double count = 0;
      Point sum{};
      for (std::size_t j = 0; j < n_; ++j) {
        if (!near(i, j)) continue;
        count += 1;
        if (!carries(i, j)) continue;
        const Point d = x_[j] - x_[i];
        sum = sum + (1 / norm(cloud_.X[j] - cloud_.X[i]) - 1 / norm(d)) * d;
      }
      if (count > 0) b = C1 * (hood(i) / count) * sum;
    });
  }
  // (15)
  std::vector<double> two(double C2) const {
    return forces([&](std::size_t i, Point& b) {
      double count = 0;
      Point sum{};
      for (std::size_t j = 0; j < n_; ++j)
        for (std::size_t k = 0; k < n_; ++k) {
          if (j == k || !near(i, j) || !near(i, k) || !near(j, k)) continue;
          const double A = norm(cross(cloud_.X[j] - cloud_.X[i], cloud_.X[k] - cloud_.X[i]));
          if (A <= 1e-9 * horizon_ * horizon_) continue;
          count += 1;
          if (!carries(i, j) || !carries(i, k)) continue;
          const Point area = cross(x_[j] - x_[i], x_[k] - x_[i]);
          sum = sum + cross(x_[k] - x_[i], (1 / A - 1 / norm(area)) * area);
        }
      if (count > 0) b = 2 * C2 * (hood(i) * hood(i) / count) * sum;
    });
  }
  // (16)
  std::vector<double> three(double C3, bool signed_volume) const {
    return forces([&](std::size_t i, Point& b) {
      double count = 0;
      Point sum{};
      for (std::size_t j = 0; j < n_; ++j)
        for (std::size_t k = 0; k < n_; ++k)
          for (std::size_t l = 0; l < n_; ++l) {
            if (j == k || k == l || l == j) continue;
            if (!near(i, j) || !near(i, k) || !near(i, l) || !near(j, k) || !near(k, l) ||
                !near(l, j))
              continue;
            const double V = dot(cross(cloud_.X[j] - cloud_.X[i], cloud_.X[k] - cloud_.X[i]),
                                 cloud_.X[l] - cloud_.X[i]);
            if (std::fabs(V) <= 1e-9 * horizon_ * horizon_ * horizon_) continue;
            count += 1;
            if (!carries(i, j) || !carries(i, k) || !carries(i, l)) continue;
            const double v = dot(cross(x_[j] - x_[i], x_[k] - x_[i]), x_[l] - x_[i]);
            const double bracket = signed_volume ? (1 / V - 1 / v) * v * (V > 0 ? 1 : -1)
                                                 : (1 / std::fabs(V) - 1 / std::fabs(v)) * v;
            sum = sum + bracket * cross(x_[k] - x_[i], x_[l] - x_[i]);
          }
      const double h = hood(i);
      if (count > 0) b = 3 * C3 * (h * h * h / count) * sum;
    });
  }
  // Silling's bond-based sum, and the linear peridynamic solid of a body without damage with influence
  // horizon/L.
  std::vector<double> bonds(double c) const {
    return bonds([c](std::size_t, std::size_t) { return c; });
  }
  // c(i,j) between materials.
  template <class C>
  std::vector<double> bonds(const C& c) const {
    return forces([&](std::size_t i, Point& b) {
      for (std::size_t j = 0; j < n_; ++j) {
        if (!near(i, j) || !carries(i, j)) continue;
        const Point d = x_[j] - x_[i];
        const double L = norm(cloud_.X[j] - cloud_.X[i]), l = norm(d);
        b = b + (c(i, j) * (l - L) / L * cloud_.volume[j] / l) * d;
      }
    });
  }
  std::vector<double> state_based(double K, double mu) const {
    return state_based([=](std::size_t) { return std::array{K, mu}; });
  }
  // moduli(i): K and mu of the material of a point.
  template <class M>
  std::vector<double> state_based(const M& moduli) const {
    std::vector<double> m(n_, 0.0), theta(n_, 0.0);
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t j = 0; j < n_; ++j) {
        if (!near(i, j)) continue;
        const double L = norm(cloud_.X[j] - cloud_.X[i]), e = norm(x_[j] - x_[i]) - L;
        m[i] += horizon_ / L * L * L * cloud_.volume[j];
        theta[i] += 3 * horizon_ / L * L * e * cloud_.volume[j];
      }
      theta[i] /= m[i];
    }
    const auto force = [&](std::size_t i, double L, double e) {
      const double w = horizon_ / L;
      const auto [K, mu] = moduli(i);
      return 3 * K * theta[i] / m[i] * w * L + 15 * mu / m[i] * w * (e - theta[i] * L / 3);
    };
    return forces([&](std::size_t i, Point& b) {
      for (std::size_t j = 0; j < n_; ++j) {
        if (!near(i, j)) continue;
        const Point d = x_[j] - x_[i];
        const double L = norm(cloud_.X[j] - cloud_.X[i]), l = norm(d);
        b = b + ((force(i, L, l - L) + force(j, L, l - L)) * cloud_.volume[j] / l) * d;
      }
    });
  }
  // Conservative weights [PD weights], pair by pair and four by four; constants C1, C3 of the points.
  std::vector<double> conservative(const std::vector<double>& C1, const std::vector<double>& C3,
                                   bool signed_volume) const {
    std::vector<double> f(3 * n_, 0.0), W1(n_, 0.0), W3(n_, 0.0);
    const auto volume = [&](const std::vector<Point>& x, const std::array<std::size_t, 4>& m) {
      return dot(cross(x[m[1]] - x[m[0]], x[m[2]] - x[m[0]]), x[m[3]] - x[m[0]]);
    };
    const auto add = [&](std::size_t i, double scale, const Point& direction) {
      for (std::size_t k = 0; k < 3; ++k) f[3 * i + k] += scale * direction[k];
    };
    const auto for_sets = [&](const auto& act) {
      for (std::size_t i = 0; i < n_; ++i)
        for (std::size_t j = i + 1; j < n_; ++j) {
          if (!near(i, j)) continue;
          for (std::size_t k = j + 1; k < n_; ++k) {
            if (!near(i, k) || !near(j, k)) continue;
            for (std::size_t l = k + 1; l < n_; ++l) {
              const std::array set{i, j, k, l};
              if (near(i, l) && near(j, l) && near(k, l) &&
                  std::fabs(volume(cloud_.X, set)) > 1e-9 * horizon_ * horizon_ * horizon_)
                act(set);
            }
          }
        }
    };
    for_sets([&](const auto& set) {
      for (const std::size_t m : set) W3[m] += 1;
    });
    for (std::size_t i = 0; i < n_; ++i) {
      double count = 0;
      for (std::size_t j = 0; j < n_; ++j) count += near(i, j) ? 1 : 0;
      const double h = hood(i);
      if (count > 0) W1[i] = cloud_.volume[i] * C1[i] * h / count;
      if (W3[i] > 0) W3[i] = cloud_.volume[i] * C3[i] * h * h * h / W3[i];
    }
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t j = 0; j < n_; ++j) {
        if (!near(i, j) || !carries(i, j)) continue;
        const Point d = x_[j] - x_[i];
        const double L = norm(cloud_.X[j] - cloud_.X[i]), l = norm(d);
        add(i, 0.5 * (W1[i] + W1[j]) * (l - L) / L / l, d);
      }
    for_sets([&](const auto& set) {
      double W = 0;
      for (const std::size_t m : set) {
        double carry = 1;
        for (const std::size_t p : set) carry *= m == p || carries(m, p) ? 1 : 0;
        W += 0.25 * W3[m] * carry;
      }
      const double V = volume(cloud_.X, set), v = volume(x_, set);
      const double g =
          signed_volume ? (v / V - 1) * (V > 0 ? 1 : -1) : v / std::fabs(V) - (v > 0 ? 1 : -1);
      const Point a = x_[set[1]] - x_[set[0]], b = x_[set[2]] - x_[set[0]],
                  c = x_[set[3]] - x_[set[0]];
      const Point G[3] = {cross(b, c), cross(c, a), cross(a, b)};
      for (std::size_t k = 0; k < 3; ++k) {
        add(set[k + 1], -W * g, G[k]);
        add(set[0], W * g, G[k]);
      }
    });
    return f;
  }
  // Energy of the linear peridynamic solid with the bonds that carry, m of all bonds.
  double state_based_energy(double K, double mu) const {
    double energy = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      double m = 0, theta = 0, deviatoric = 0;
      const auto for_bonds = [&](const auto& f) {
        for (std::size_t j = 0; j < n_; ++j) {
          if (!near(i, j)) continue;
          const double L = norm(cloud_.X[j] - cloud_.X[i]);
          f(L, norm(x_[j] - x_[i]) - L, horizon_ / L * cloud_.volume[j], carries(i, j));
        }
      };
      for_bonds([&](double L, double e, double w, bool carries_bond) {
        m += w * L * L;
        if (carries_bond) theta += 3 * w * L * e;
      });
      theta /= m;
      for_bonds([&](double L, double e, double w, bool carries_bond) {
        const double part = e - theta * L / 3;
        if (carries_bond) deviatoric += w * part * part;
      });
      energy += cloud_.volume[i] * (0.5 * K * theta * theta + 7.5 * mu / m * deviatoric);
    }
    return energy;
  }

 private:
  bool near(std::size_t i, std::size_t j) const {
    return i != j && norm(cloud_.X[j] - cloud_.X[i]) <= horizon_;
  }
  bool carries(std::size_t i, std::size_t j) const { return intact_[i * n_ + j] != 0; }
  // v_i b_i of all points
  template <class F>
  std::vector<double> forces(const F& density) const {
    std::vector<double> f(3 * n_, 0.0);
    for (std::size_t i = 0; i < n_; ++i) {
      Point b{};
      density(i, b);
      for (std::size_t k = 0; k < 3; ++k) f[3 * i + k] = cloud_.volume[i] * b[k];
    }
    return f;
  }

  const Cloud& cloud_;
  double horizon_;
  std::size_t n_;
  std::vector<char> intact_;
  std::vector<Point> x_;
};

inline std::vector<double> plus(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] += b[k];
  return a;
}

}  // namespace cleave::test
