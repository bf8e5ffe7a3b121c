/* peer_opencv.cpp - OpenCV: area and moments to degree 3 of contours of floats.
 *
 * OpenCV closes a contour by itself, so the repeated vertex is left out. Its sign says the same as
 * ours: counterclockwise is positive where y points up; but moments() of a clockwise contour are
 * made positive, which does not happen here. */
#include "peers.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <vector>

namespace {

typedef std::vector<std::vector<cv::Point2f>> Set;

void *prepare(const double *x, const double *y, const int32_t *offsets, size_t rings)
{
	Set *set = new Set(rings);
	for (size_t i = 0; i < rings; ++i)
		for (int32_t k = offsets[i]; k < offsets[i + 1] - 1; ++k)
			(*set)[i].push_back(cv::Point2f(float(x[k]), float(y[k])));
	return set;
}

void release(void *set)
{
	delete static_cast<Set *>(set);
}

void area(const void *set, double *out)
{
	for (const std::vector<cv::Point2f> &contour : *static_cast<const Set *>(set))
		*out++ = cv::contourArea(contour, true);
}

void moments(const void *set, double *out)
{
	for (const std::vector<cv::Point2f> &contour : *static_cast<const Set *>(set)) {
		const cv::Moments m = cv::moments(contour);
		const double raw[] = { m.m00, m.m10, m.m01, m.m20, m.m11, m.m02, m.m30, m.m21,
			m.m12, m.m03 };
		for (double value : raw)
			*out++ = value;
	}
}

}

const Peer peer_OpenCV = { prepare, release, { area, nullptr, moments } };
