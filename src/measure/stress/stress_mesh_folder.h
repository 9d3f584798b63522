#pragma once
#include <filesystem>
#include <string>

namespace bruma::measure {

/// A folder for files with faults, gone when the suite is over.
class StressFolder {
  public:
    StressFolder();
    ~StressFolder();
    StressFolder(const StressFolder&) = delete;
    StressFolder& operator=(const StressFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path write(const std::string& name, const std::string& bytes) const;

  private:
    std::filesystem::path path_;
};

}  // namespace bruma::measure
