// Trajectories in the forms of TUM and EuRoC.
#include "sunlit/evaluate/trajectory/trajectory.h"
#include "fuzz/reader.h"
#include "support/temporary_folder.h"

namespace sunlit::fuzz {

std::vector<std::string> seeds() {
  return {
      "# timestamp tx ty tz qx qy qz qw\n1000.1 0 0 0 0 0 0 1\n1000.2 1 0.5 0 0 0 0.7071068 0.7071068\n"
      "1.0003e3 2 0.5 0 0 0 0 -1\n",
      "#timestamp,p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z []\n"
      "1403636580838555648,4.6,-1.7,0.7,1,0,0,0\n1403636580843555648,4.6,-1.7,0.8,0.8,0.6,0,0\n",
      "1403636580838555648,4.6,-1.7,0.7,1,0,0,0,0,0,0,0,0,0,0,0,0\n"};
}

void read(const std::string& input) {
  setContent("./input.txt", input);
  std::vector<std::int64_t> repeated;
  const evaluate::Trajectory trajectory = evaluate::readTrajectory("input.txt", &repeated);
  evaluate::writeTrajectory("output.txt", trajectory);
  evaluate::readTrajectory("output.txt", nullptr);
}

std::string named() {
  return "put.txt";
}

}  // namespace sunlit::fuzz
