# sunlit on Debian 12.
#   docker build -t sunlit .
#   docker run --rm -v "$PWD/output:/sunlit/output" sunlit    # scripts/demo; results in output/
#   docker run --rm sunlit scripts/test
FROM debian:bookworm
WORKDIR /sunlit
COPY scripts/install_dependencies scripts/
RUN scripts/install_dependencies
COPY . .
RUN scripts/build
CMD ["scripts/demo"]
