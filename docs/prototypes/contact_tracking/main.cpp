#include <chrono>
#include <cstdio>
#include <cstring>

#include "scenes.hpp"

int main(int n, char** v) {
  // main METHOD FAMILY-PART [scene | "bad"] [seeds] [first seed]
  std::string method = n > 1 ? v[1] : "tracked", part = n > 2 ? v[2] : "", one = n > 3 ? v[3] : "";
  const int seeds = n > 4 ? atoi(v[4]) : 60, first = n > 5 ? atoi(v[5]) : 0;
  SurfaceOptions so;
  (void)so;
  const auto make = [&]() -> std::unique_ptr<Method> {
    if (method == "closest") return std::make_unique<ClosestMethod>();
    Rules r;
    if (method == "-facing") r.facing = false;
    if (method == "-fade") r.fade = false;
    if (method == "-offset") r.offset = false;
    if (method == "-others") r.others = false;
    if (method == "-sideways") r.sideways = false;
    if (method == "-linger") r.linger = false;
    if (getenv("HOLD")) r.hold = atof(getenv("HOLD"));
    if (method == "-thickness") r.thickness = false;
    if (method == "-middle") r.middle = false;
    if (method == "-groups") r.groups = false;
    if (method == "-smooth") r.smooth = false;
    if (method == "-round") r.round = false;
    if (method == "-overlap") r.overlap = 0;
    return std::make_unique<TrackedMethod>(r);
  };
  std::vector<Family> all{flush(),
                          bars(),
                          rims(),
                          plates(),
                          table(),
                          parts(),
                          sheets(),
                          angles(true),
                          angles(false),
                          pits(),
                          ties(),
                          rolling(),
                          rounded(),
                          accepted(),
                          thrown(false, seeds, first),
                          thrown(true, seeds, first),
                          thrown(false, seeds, first, .02),
                          thrown(true, seeds, first, .02),
                          crossing(),
                          layers(),
                          carried(),
                          soft()};
  int bad_all = 0, count_all = 0;
  for (auto& F : all) {
    if (F.name.find(part) == std::string::npos) continue;
    int bad = 0, created = 0, lost = 0, missed = 0, wrong = 0, count = 0;
    double most = 0;
    const auto t0 = std::chrono::steady_clock::now();
    for (auto& [name, scene] : F.scenes) {
      if (!one.empty() && one != "bad" && one != name) continue;
      Scene s = scene();
      const Verdict r = s.run(make, one == name);
      ++count;
      bad += r.bad();
      created += r.created > .01;
      lost += r.lost > .01;
      missed += r.missed;
      wrong += r.wrong;
      most = std::max(most, r.created);
      if (r.bad() && !one.empty())
        printf("   %s: created %.4f lost %.4f missed %d (%.3f) wrong %d deepest %.4f\n", name.c_str(), r.created, r.lost, r.missed,
               r.missed_depth, r.wrong, r.deepest);
      else if (one == name)
        printf("   %s: good created %.4f lost %.4f deepest %.4f dt %g\n", name.c_str(), r.created, r.lost, r.deepest, s.dt);
    }
    const double t = std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count();
    printf("%-10s %-28s bad %4d / %4d   created %d lost %d missed %d wrong %d   most created %.3g   %.1f s\n", method.c_str(),
           F.name.c_str(), bad, count, created, lost, missed, wrong, most, t);
    fflush(stdout);
    bad_all += bad;
    count_all += count;
  }
  printf("%-10s all %d / %d\n", method.c_str(), bad_all, count_all);
}
