#include "tools/atlas_slurm.h"

#include <sys/wait.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "sunlit/image/files.h"

namespace sunlit::tools {

namespace {

namespace fs = std::filesystem;

/// As one word of the shell.
std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

struct Job {
  std::string name;      ///< of script, log and job
  std::size_t tasks;     ///< of the array; 0: no array
  std::string its_part;  ///< arguments, words of the shell
};

std::string scriptOf(const AtlasRunOptions& options, const std::string& folder, const Job& job) {
  std::string text = "#!/bin/bash\n#SBATCH --job-name=atlas_" + job.name + '\n';
  if (job.tasks > 0) text += "#SBATCH --array=1-" + std::to_string(job.tasks) + '\n';
  text += "#SBATCH --output=\"" + folder + '/' + job.name + (job.tasks > 0 ? "_%a" : "") + ".log\"\n";
  text += "#SBATCH --chdir=\"" + fs::current_path().string() + "\"\n";
  for (const std::string& option : options.slurm->options) text += "#SBATCH " + option + '\n';
  text += "exec " + quoted(fs::read_symlink("/proc/self/exe").string());
  for (const std::string& word : options.again) text += " \\\n  " + quoted(word);
  return text + " \\\n  " + job.its_part + " \\\n  --out=" + quoted(fs::absolute(options.output).string()) +
         '\n';
}

/// What `command` prints. Throws std::runtime_error where it fails; why, it has said itself.
std::string outputOf(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
  if (!pipe) throw std::runtime_error("sbatch cannot be started");
  std::string text;
  for (int c = std::fgetc(pipe.get()); c != EOF; c = std::fgetc(pipe.get())) text += static_cast<char>(c);
  return text;
}

/// The number of the job. Prints nothing else: a cluster's name may stand behind a semicolon.
std::string submit(const std::string& script, const std::string& after) {
  const std::string dependency = after.empty() ? "" : " --dependency=afterok:" + after;
  std::string number = outputOf("sbatch --parsable" + dependency + ' ' + quoted(script));
  number = number.substr(0, number.find_first_of(";\n"));
  const bool is_number = !number.empty() && std::all_of(number.begin(), number.end(),
                                                        [](unsigned char c) { return std::isdigit(c); });
  if (!is_number)
    throw std::runtime_error(script + ": sbatch did not take it" +
                             (after.empty() ? "" : "; job " + after + " stays, scancel ends it"));
  return number;
}

std::string shareOf(const std::string& stage, std::size_t tasks) {
  return "--stage=" + stage + " --shard=\"$SLURM_ARRAY_TASK_ID/" + std::to_string(tasks) + '"';
}

}  // namespace

void runBySlurm(const AtlasRunOptions& options, const AtlasFolder& folder) {
  const auto most = static_cast<std::size_t>(options.slurm->tasks);
  const std::size_t observers = std::min(most, folder.observeUnits().size());
  const std::size_t comparers = std::min(most, folder.compareUnits().size());
  const std::string scripts = fs::absolute(folder.file("slurm")).string();
  image::makeFolder(scripts);
  std::string after;
  for (const Job& job :
       {Job{"observe", observers, shareOf("observe", observers)},
        Job{"compare", comparers, shareOf("compare", comparers)}, Job{"merge", 0, "--merge"}}) {
    const std::string script = scripts + '/' + job.name + ".sh";
    image::writeFileAtomically(script, scriptOf(options, scripts, job));
    std::printf("%s", script.c_str());
    if (options.slurm->submits) {
      after = submit(script, after);
      std::printf(": job %s", after.c_str());
    }
    std::printf(job.tasks > 0 ? ", %zu tasks\n" : "\n", job.tasks);
    std::fflush(stdout);
  }
}

}  // namespace sunlit::tools
