(** The figures of the IMC platform, on loopback with simulated vehicles in a process of their own: the time from the
    end of a plan to the next request on the wire, the time from the last vehicle's appearance to the first request,
    the cost of waiting, the cost and losses of a flood of telemetry. *)
