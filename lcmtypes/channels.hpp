#pragma once

/// The names of the channels.
namespace floornav::channel {

inline constexpr const char* kKinectCloud = "KINECT_CLOUD";        ///< depth_cloud_t
inline constexpr const char* kKinectImage = "KINECT_IMAGE";        ///< image_t
inline constexpr const char* kBumblebeeCloud = "BUMBLEBEE_CLOUD";  ///< depth_cloud_t
inline constexpr const char* kPose = "POSE";                       ///< pose_t
inline constexpr const char* kLocalToGlobal = "LOCAL_TO_GLOBAL";   ///< rigid_transform_t
inline constexpr const char* kSurfels = "SURFELS";                 ///< surfels_t
inline constexpr const char* kGridMap = "GRID_MAP";                ///< grid_map_t
inline constexpr const char* kTerrainMap = "TERRAIN_MAP";          ///< terrain_map_t
inline constexpr const char* kMapRequest = "MAP_REQUEST";          ///< map_request_t
inline constexpr const char* kGoal = "GOAL";                       ///< goal_t
inline constexpr const char* kPath = "PATH";                       ///< path_t
inline constexpr const char* kHealth = "HEALTH";                   ///< health_t

}  // namespace floornav::channel
