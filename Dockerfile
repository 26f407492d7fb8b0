# SPDX-License-Identifier: Apache-2.0
#
# The program in an image of its own:
#   docker build -t lightwell .
#   docker run --rm -v "$PWD:/scenes" lightwell bake room.glb -o room.lw.glb
#   docker run --rm -v "$PWD:/scenes" -p 8080:8080 lightwell serve . --bind 0.0.0.0
FROM debian:12 AS build
COPY . /lightwell
RUN /lightwell/run package

FROM debian:12-slim
RUN --mount=from=build,source=/lightwell/build/package,target=/package \
    apt-get update && apt-get install -y --no-install-recommends /package/lightwell_*.deb && rm -rf /var/lib/apt/lists/*
WORKDIR /scenes
EXPOSE 8080
ENTRYPOINT ["lightwell"]
CMD ["--help"]
