# SPDX-License-Identifier: GPL-2.0-or-later
"""What may be asked for: grains, models, parameters, hosts; and a request with its record."""
