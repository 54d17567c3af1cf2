#include "tools/simulator/scene_file.hpp"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace floornav {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kHead = "name: test\narea_m: [-1, -1, 1, 1]\n";

std::string error_of(const std::string& text) {
  try {
    parse_scene(text, "room.yaml");
  } catch (const SceneError& e) {
    return e.what();
  }
  return "accepted";
}

struct Wrong {
  const char* name;
  std::string text;
  std::string where;  ///< file and line, key
  std::string reason;
};

class WrongScene : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongScene, IsRefusedWithFileKeyAndReason) {
  const std::string message = error_of(GetParam().text);
  EXPECT_THAT(message,
              AllOf(HasSubstr("room.yaml"), HasSubstr(GetParam().where), HasSubstr(GetParam().reason)));
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    Table, WrongScene,
    ::testing::Values(
        Wrong{"empty", "", "scene", "must be a map"},
        Wrong{"not_yaml", "name: [1, 2", "room.yaml:", "not YAML"},
        Wrong{"a_list", "- 1\n- 2\n", "scene", "must be a map"},
        Wrong{"no_name", "area_m: [0, 0, 1, 1]\nobjects: []\n", "scene", "key 'name' is missing"},
        Wrong{"no_objects", kHead, "scene", "key 'objects' is missing"},
        Wrong{"unknown_key", kHead + "objects: []\ncolour: red\n", "room.yaml:4: colour",
              "unknown key, allowed are: name"},
        Wrong{"key_twice", kHead + "name: again\nobjects: []\n", "room.yaml", "is given twice"},
        Wrong{"area_inside_out", "name: a\narea_m: [1, 1, -1, -1]\nobjects: []\n", "area_m", "x_min, y_min"},
        Wrong{"area_of_three", "name: a\narea_m: [1, 1, 2]\nobjects: []\n", "area_m", "list of 4 numbers"},
        Wrong{"objects_no_list", kHead + "objects: 3\n", "objects", "must be a list"},
        Wrong{"object_no_map", kHead + "objects: [3]\n", "objects[0]", "must be a map"},
        Wrong{"object_two_kinds", kHead + "objects:\n  - {box: {}, wall: {}}\n", "objects[0]", "one key"},
        Wrong{"unknown_object", kHead + "objects:\n  - sofa: {}\n", "objects[0].sofa",
              "unknown kind of object, allowed are: box"},
        Wrong{"box_without_size", kHead + "objects:\n  - box: {center_m: [0, 0]}\n", "objects[0].box",
              "'size_m' is missing"},
        Wrong{"box_of_words", kHead + "objects:\n  - box: {center_m: [0, 0], size_m: [a, b, c]}\n",
              "objects[0].box.size_m", "must be a number"},
        Wrong{"box_of_no_height", kHead + "objects:\n  - box: {center_m: [0, 0], size_m: [1, 1, 0]}\n",
              "objects[0].box.size_m", "is 0, allowed is 0.001 to 1000"},
        Wrong{"box_with_wrong_unit", kHead + "objects:\n  - box: {center_cm: [0, 0], size_m: [1, 1, 1]}\n",
              "objects[0].box", "'center_m' is missing"},
        Wrong{"box_with_typing_error",
              kHead + "objects:\n  - box: {center_m: [0, 0], size_m: [1, 1, 1], jaw_deg: 3}\n",
              "room.yaml:4: objects[0].box.jaw_deg", "unknown key"},
        Wrong{"box_nan", kHead + "objects:\n  - box: {center_m: [.nan, 0], size_m: [1, 1, 1]}\n", "center_m",
              "must be a number"},
        Wrong{"box_turned_too_far",
              kHead + "objects:\n  - box: {center_m: [0, 0], size_m: [1, 1, 1], yaw_deg: 4000}\n", "yaw_deg",
              "allowed is -360 to 360"},
        Wrong{"second_object",
              kHead + "objects:\n  - cylinder: {center_m: [0, 0], radius_m: 1, height_m: 1}\n  - cylinder: "
                      "{center_m: [0, 0], radius_m: -1, height_m: 1}\n",
              "room.yaml:5: objects[1].cylinder.radius_m", "is -1"},
        Wrong{"wall_of_no_length",
              kHead + "objects:\n  - wall: {from_m: [1, 1], to_m: [1, 1], height_m: 1}\n",
              "objects[0].wall.to_m", "same place"},
        Wrong{"carpet_half_wave",
              kHead +
                  "objects:\n  - carpet: {center_m: [0, 0], size_m: [1, 1], amplitude_m: 0.01, waves: 1.5}\n",
              "waves", "whole number"},
        Wrong{
            "stairs_of_none",
            kHead + "objects:\n  - stairs_down: {center_m: [0, 0], size_m: [1, 1], steps: 0, rise_m: 0.15}\n",
            "steps", "is 0"},
        Wrong{"table_thicker_than_high",
              kHead + "objects:\n  - table: {center_m: [0, 0], size_m: [1, 1, 0.5], thickness_m: 0.6}\n",
              "thickness_m", "less than"},
        Wrong{"table_with_fat_legs",
              kHead + "objects:\n  - table: {center_m: [0, 0], size_m: [0.2, 1, 0.5], leg_radius_m: 0.06}\n",
              "leg_radius_m", "no room"},
        Wrong{"holes_overlap",
              kHead + "objects:\n  - drop: {center_m: [0, 0], size_m: [1, 1], depth_m: 1}\n  - drop: "
                      "{center_m: [0.6, 0.6], size_m: [1, 1], yaw_deg: 45, depth_m: 1}\n",
              "objects", "overlap"},
        Wrong{"person_who_stands", kHead + "objects:\n  - person: {from_m: [0, 0], to_m: [0, 0]}\n",
              "person.to_m", "less than 0.1 m"},
        Wrong{"drive_too_short", kHead + "objects: []\ndrive: {waypoints_m: [[0, 0], [1, 1]]}\n",
              "drive.waypoints_m", "4 or more points"},
        Wrong{"drive_point_of_three",
              kHead + "objects: []\ndrive: {waypoints_m: [[0, 0], [1, 1], [2, 2], [3, 3, 3]]}\n",
              "drive.waypoints_m", "each [x, y]"},
        Wrong{"drive_too_fast",
              kHead + "objects: []\ndrive: {speed_mps: 50, waypoints_m: [[0, 0], [1, 1], [2, 2], [3, 3]]}\n",
              "drive.speed_mps", "is 50"},
        Wrong{"goal_of_one", kHead + "objects: []\ngoal_m: [1]\n", "goal_m", "list of 2 numbers"},
        Wrong{"ground_too_steep", kHead + "objects: []\nground: {slope: [3, 0]}\n", "ground.slope", "is 3"}),
    [](const auto& info) { return info.param.name; });

TEST(SceneFile, AMissingFileIsNamed) {
  EXPECT_THROW(
      try { load_scene("/nowhere/room.yaml"); } catch (const SceneError& e) {
        EXPECT_STREQ(e.what(), "/nowhere/room.yaml: cannot be opened");
        throw;
      },
      SceneError);
}

TEST(SceneFile, DropsThatTouchDoNotOverlap) {
  EXPECT_EQ(error_of(kHead + "objects:\n  - drop: {center_m: [0, 0], size_m: [1, 1], depth_m: 1}\n"
                             "  - drop: {center_m: [1, 0], size_m: [1, 1], depth_m: 2}\n"),
            "accepted");
}

TEST(SceneFile, EverySceneOfTheProjectIsAccepted) {
  int scenes = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(FLOORNAV_SOURCE_DIR "/tools/simulator/scenes")) {
    if (entry.path().extension() != ".yaml") continue;
    EXPECT_NO_THROW(load_scene(entry.path().string())) << entry.path();
    ++scenes;
  }
  EXPECT_GE(scenes, 1);
}

}  // namespace
}  // namespace floornav
